// A panel with curves of any numbers of one robot or of several, at the rate of their cycles.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { button, complain, download, eachFrame, make, select } from "../view/dom";
import { number, plural } from "../view/format";
import { arrange } from "../view/renew";
import type { Welcome } from "../protocol";
import { nameOf } from "../store/paths";
import { isSameRun } from "../store/run";
import { Curve, isShared, kept, lookOfOtherRun, looksOf, nameIn, wantedIn, type Look, type Wanted } from "./curve";
import { Held, type Part } from "./held";
import { numberSetting, type Context, type Panel, type PanelKind } from "./panel";
import { align, incomparable, readCurves, robotChoice, robotMark, type Series } from "./series";

const WINDOWS = ["5 s", "10 s", "20 s", "60 s", "300 s"];
const EVERYBODY = "all\u00a0\u00a0\u00a0\u00a0\u00a0\u00a0robots";
/** Clocks of robots are known so well, in seconds. */
const SLACK = 1;

interface Line {
  label: string;
  look: Look;
  series: Series;
  isOfOtherRun: boolean;
}

class Plot implements Panel {
  readonly content = make("div", { class: "plot" });
  readonly tools: HTMLElement[];
  private readonly curves: Curve[] = [];
  private readonly chart = make("div", { class: "chart" });
  private readonly chips = make("div", { class: "bar chips" });
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly missing = make("output", { class: "muted" });
  private readonly pause: HTMLButtonElement;
  private readonly input = make("input", { type: "text", placeholder: "add a path", "aria-label": "add a path", spellcheck: "false" });
  /** Of which robot the next curve is; only where there are several. */
  private readonly whose: HTMLSelectElement;
  private readonly draw = eachFrame(() => this.update());
  private window: number;
  private readonly held = new Held();
  private readonly earlier = make("output", { class: "earlier", hidden: true }, "an earlier run: Go on shows the one that goes on now");
  private drawn: uPlot | null = null;
  /** What the chart has, the curves first. */
  private lines: Line[] = [];
  /** Curves of another run, by name. */
  private others: ReadonlyMap<string, Series> | null = null;
  /** Why a file was not read. */
  private unread: string | null = null;
  /** Whose points there are. */
  private run: Welcome | null = null;
  private readonly stop: () => void;

  constructor(private readonly context: Context) {
    this.window = numberSetting(context.settings, "window", 20);
    this.pause = button("Pause", "hold the picture; drag in it to see a part, double click to go on", () => this.hold());
    this.tools = [
      select(WINDOWS, `${this.window} s`, "how much is shown", (choice) => {
        this.window = Number.parseFloat(choice);
        this.go();
        this.save();
      }),
      this.pause,
      button("CSV", "save what is shown", () => this.export()),
      compare((others) => {
        this.others = others;
        this.rebuild();
      }, (wrong) => {
        this.unread = wrong;
        this.tell();
      }),
    ];
    const { robots, known } = context;
    this.whose = select([...robots.map(robotChoice), EVERYBODY], robotChoice(known), "whose numbers are added: typed or dropped", () => undefined);
    this.whose.classList.add("whose");
    this.whose.hidden = robots.length < 2;
    this.input.addEventListener("change", () => {
      if (this.input.value.trim() !== "") this.accept(this.input.value.trim());
      this.input.value = "";
    });
    this.content.append(this.chips, this.failure, this.chart);
    this.chart.addEventListener("dblclick", () => this.go());
    for (const wanted of wantedIn(context.settings)) this.add(wanted);
    this.rebuild();
    const stops = [
      context.robot.moment.changed((moment) => {
        // What is held of an earlier run stays until somebody goes on: times of this one are none of its own.
        if (moment === null || this.held.isEarlier) return;
        this.held.hold([moment.time - this.window / 2, moment.time + this.window / 2], this.curves);
        this.show();
      }),
      context.robot.welcome.watch((welcome) => this.goOnWith(welcome)),
    ];
    // The axes are drawn in colours of the page.
    const repaint = (): void => this.rebuild();
    window.addEventListener("look", repaint);
    this.stop = () => {
      stops.forEach((stop) => stop());
      window.removeEventListener("look", repaint);
    };
  }

  accept(path: string): void {
    const { robots, known } = this.context;
    const chosen = robots.filter((one) => this.whose.value === EVERYBODY || this.whose.value === robotChoice(one));
    // The panel's own robot is not named: the curve goes with the panel to another one.
    for (const one of chosen) this.add(one === known ? { path } : { path, robot: one.address });
    this.rebuild();
    this.save();
  }

  resized(): void {
    const { clientWidth, clientHeight } = this.chart;
    this.drawn?.setSize({ width: clientWidth, height: Math.max(clientHeight - legendHeight(this.chart), 60) });
  }

  close(): void {
    this.stop();
    for (const curve of this.curves) curve.close();
    this.drawn?.destroy();
  }

  private add(wanted: Wanted): void {
    const { known: own, robots, robot } = this.context;
    const known = wanted.robot === undefined ? own : (robots.find(({ address }) => address === wanted.robot) ?? null);
    const isThere = this.curves.some((curve) => curve.wanted.path === wanted.path && (curve.known === null ? curve.wanted.robot === wanted.robot : curve.known === known));
    if (!isThere) this.curves.push(new Curve(wanted, known, robot, this.draw, () => this.tell()));
  }

  private drop(curve: Curve): void {
    curve.close();
    this.curves.splice(this.curves.indexOf(curve), 1);
    this.rebuild();
    this.save();
  }

  private save(): void {
    this.context.save({ paths: this.curves.map(({ wanted }) => kept(wanted)), window: this.window });
  }

  /** What is wrong with curves, and whose robots are not there. */
  private tell(): void {
    const failures = this.curves.flatMap(({ failure, wanted }) => (failure === null ? [] : [`${wanted.path}: ${failure}`]));
    const others = this.others === null ? null : incomparable(this.others, this.curves.map(({ wanted }) => nameIn(wanted)));
    failures.push(...[this.unread, others].filter((wrong) => wrong !== null));
    complain(this.failure, failures.length > 0 ? failures.join("\n") : null);
    const missing = this.curves.reduce((sum, curve) => sum + this.held.shown(curve).missing, 0);
    this.missing.textContent = missing === 0 ? "" : `gaps: ${plural(missing, "value")} did not come through`;
    this.curves.forEach((curve, at) => this.chips.children[at]?.classList.toggle("lost", !curve.isThere));
  }

  /** As legend and head call it. */
  private label({ wanted, known }: Curve): string {
    // Of a part of a list, the list's name, too.
    const name = /\.\d+$/.test(wanted.path) ? shortly(wanted.path) : nameOf(wanted.path);
    return isShared(this.curves) ? `${known === null ? wanted.robot : robotMark(known.at)} ${name}` : name;
  }

  private chip(curve: Curve, look: Look): HTMLElement {
    const { wanted, known } = curve;
    const swatch = make("span", { class: "swatch" });
    swatch.style.background = stroke(look);
    const mark = make("span", { class: "robot-mark" }, known === null ? "?" : robotMark(known.at));
    mark.style.setProperty("--robot", look.color);
    const gone = button("×", `remove ${nameIn(wanted)}`, () => this.drop(curve), "plain");
    return make("span", { class: "chip", title: nameIn(wanted) }, swatch, isShared(this.curves) ? mark : null, shortly(wanted.path), gone);
  }

  private rebuild(): void {
    const looks = looksOf(this.curves);
    this.lines = this.curves.map((curve, at) => ({ label: this.label(curve), look: looks[at] as Look, series: this.held.shown(curve).series, isOfOtherRun: false }));
    this.context.title(this.lines.map(({ label }) => label).join(", "));
    // Whoever types the next path goes on to.
    arrange(this.chips, [...this.curves.map((curve, at) => this.chip(curve, looks[at] as Look)), this.input, this.whose, this.missing, this.earlier]);
    this.tell();
    // Curves that the other run has, too.
    this.curves.forEach((curve, at) => {
      const series = this.others?.get(nameIn(curve.wanted));
      if (series !== undefined) this.lines.push({ label: `${this.label(curve)} of the other run`, look: lookOfOtherRun(looks[at] as Look), series, isOfOtherRun: true });
    });
    this.drawn?.destroy();
    this.chart.classList.toggle("unused", this.curves.length === 0);
    const ink = getComputedStyle(document.body).getPropertyValue("--faint");
    const line = getComputedStyle(document.body).getPropertyValue("--rule");
    const small = getComputedStyle(document.body).getPropertyValue("--small");
    const font = `${small} system-ui, sans-serif`;
    const width = (values: string[] | null): number => Math.max(64, 24 + 0.6 * Number.parseFloat(small) * Math.max(0, ...(values ?? []).map(({ length }) => length)));
    const axis = { font, stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 } };
    const options: uPlot.Options = {
      width: Math.max(this.chart.clientWidth, 100),
      height: Math.max(this.chart.clientHeight - 30, 60),
      scales: { x: { time: false } },
      axes: [{ ...axis, values: (_, ticks) => ticks.map((tick) => `${short(tick)} s`) }, { ...axis, size: (_, values) => width(values), values: (_, ticks) => ticks.map(short) }],
      cursor: { drag: { x: true, y: false, setScale: false } },
      series: [
        { label: "time", value: (_, time) => (time === null ? "–" : `${time.toFixed(3)} s`) },
        ...this.lines.map(seriesOf),
      ],
      legend: { markers: { width: 0, fill: (_, at) => stroke((this.lines[at - 1] as Line).look) } },
      hooks: { setSelect: [(chart) => this.zoom(chart)] },
    };
    this.drawn = new uPlot(options, this.shown() as uPlot.AlignedData, this.chart);
    requestAnimationFrame(() => this.resized());
  }

  /** The newest time of all curves: instances without a value for a while do not hold the others back. */
  private newest(): number {
    return Math.max(0, ...this.curves.map(({ series }) => series.times[series.times.length - 1] ?? 0));
  }

  private range(): Part {
    return this.held.part ?? [this.newest() - this.window, this.newest()];
  }

  private shown(): ReturnType<typeof align> {
    return align(this.lines.map(({ series }) => series), ...this.range());
  }

  private update(): void {
    if (this.held.part === null) this.take();
  }

  private goOnWith(welcome: Welcome | null): void {
    if (welcome === null) return;
    const begun = this.curves.map((curve) => curve.begin(isSameRun(this.run, welcome), welcome.time / 1e9 + SLACK));
    this.run = welcome;
    if (begun.includes(true)) {
      this.held.endRun();
      // Curves that came while it was held have had points that go on, of another clock from now on.
      this.take();
      this.tell();
    }
    this.earlier.hidden = !this.held.isEarlier;
  }

  private hold(): void {
    if (this.held.part !== null) return this.go();
    this.held.hold(this.range(), this.curves);
    this.show();
  }

  private zoom(chart: uPlot): void {
    const { left, width } = chart.select;
    if (width < 5) return;
    const part: Part = [chart.posToVal(left, "x"), chart.posToVal(left + width, "x")];
    chart.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.held.zoom(part, this.curves);
    this.show();
  }

  /** What is held. */
  private show(): void {
    this.pause.textContent = "Go on";
    this.take();
    this.tell();
  }

  private go(): void {
    this.held.go();
    this.pause.textContent = "Pause";
    this.earlier.hidden = true;
    this.take();
    this.tell();
  }

  /** Draws the points that are to be shown by now. */
  private take(): void {
    this.curves.forEach((curve, at) => ((this.lines[at] as Line).series = this.held.shown(curve).series));
    const [min, max] = this.range();
    this.drawn?.batch(() => {
      this.drawn?.setData(this.shown() as uPlot.AlignedData, false);
      this.drawn?.setScale("x", { min, max });
    });
  }

  private export(): void {
    const [times, ...all] = this.shown();
    const columns = all.slice(0, this.curves.length);
    const head = ["time", ...this.curves.map(({ wanted }) => nameIn(wanted))].join(",");
    const rows = times.map((time, row) => [time, ...columns.map((column) => column[row] ?? "")].join(","));
    download("plot.csv", `${[head, ...rows].join("\n")}\n`, "text/csv");
  }
}

function seriesOf({ label, look, isOfOtherRun }: Line): uPlot.Series {
  const value = (_: uPlot, value: number | null): string => (value === null || value === undefined ? "–" : number(value));
  return { label, stroke: look.color, dash: look.dash, width: isOfOtherRun ? 2 : 1.5, spanGaps: isOfOtherRun, points: { show: false }, value };
}

/** Opens curves that another plot has saved, of another run over the same seconds. */
function compare(deed: (others: Map<string, Series> | null) => void, refused: (reason: string | null) => void): HTMLElement {
  const file = make("input", { type: "file", accept: ".csv,text/csv", hidden: true, "aria-label": "curves of another run" });
  file.addEventListener("change", () => {
    // What was wrong with a file is over with the next one, or with none.
    refused(null);
    const [chosen] = file.files ?? [];
    if (chosen === undefined) return deed(null);
    chosen.text().then(
      (text) => deed(readCurves(text)),
      (error: unknown) => refused(`${chosen.name} cannot be read: ${error instanceof Error ? error.message : String(error)}`),
    ).finally(() => (file.value = ""));
  });
  return make("span", {}, file, button("Compare", "show curves of another run that were saved with CSV, dashed", () => file.click()));
}

/** As many digits as tell the ticks of an axis apart. */
function short(tick: number): string {
  return String(Number(tick.toPrecision(6)));
}

/** The last two names: as much as tells curves apart in most panels. */
function shortly(path: string): string {
  return path.split(".").slice(-2).join(".");
}

/** The background that shows how a curve is drawn. */
function stroke({ color, dash }: Look): string {
  let end = 0;
  const stops = dash.map((length, at) => `${at % 2 === 0 ? color : "transparent"} ${end}px ${(end += length)}px`);
  return stops.length === 0 ? color : `repeating-linear-gradient(90deg, ${stops.join(", ")})`;
}

function legendHeight(chart: HTMLElement): number {
  return chart.querySelector<HTMLElement>(".u-legend")?.offsetHeight ?? 0;
}

export const plot: PanelKind = { kind: "plot", name: "Plot", open: (context) => new Plot(context), showsRobots: true };
