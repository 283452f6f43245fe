// A panel with curves of any numbers of the robot, at the rate of its cycles.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { button, complain, download, eachFrame, make, select } from "../view/dom";
import { number } from "../view/format";
import { nameOf } from "../store/paths";
import { listSetting, numberSetting, type Context, type Panel, type PanelKind } from "./panel";
import { align, COLORS, height, readCurves, Series } from "./series";

const WINDOWS = ["5 s", "10 s", "20 s", "60 s", "300 s"];

interface Curve {
  path: string;
  series: Series;
  stop(): void;
}

class Plot implements Panel {
  readonly content = make("div", { class: "plot" });
  readonly tools: HTMLElement[];
  private readonly curves: Curve[] = [];
  private readonly chart = make("div", { class: "chart" });
  private readonly chips = make("div", { class: "bar chips" });
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly pause: HTMLButtonElement;
  private readonly input = make("input", { type: "text", placeholder: "add a path", "aria-label": "add a path", spellcheck: "false" });
  private readonly draw = eachFrame(() => this.update());
  private window: number;
  /** While paused: what is shown, in seconds. */
  private held: [number, number] | null = null;
  private drawn: uPlot | null = null;
  /** Curves of another run, by path. */
  private others = new Map<string, Series>();
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
      }, this.failure),
    ];
    this.input.addEventListener("change", () => {
      if (this.input.value.trim() !== "") this.accept(this.input.value.trim());
      this.input.value = "";
    });
    this.content.append(this.chips, this.failure, this.chart);
    this.chart.addEventListener("dblclick", () => this.go());
    for (const path of listSetting(context.settings, "paths")) this.add(path);
    this.rebuild();
    const stop = context.robot.moment.watch((moment) => {
      if (moment !== null) this.show([moment.time - this.window / 2, moment.time + this.window / 2]);
    });
    // The axes are drawn in colours of the page.
    const repaint = (): void => this.rebuild();
    window.addEventListener("look", repaint);
    this.stop = () => {
      stop();
      window.removeEventListener("look", repaint);
    };
  }

  accept(path: string): void {
    if (this.curves.some((curve) => curve.path === path)) return;
    this.add(path);
    this.rebuild();
    this.save();
  }

  resized(): void {
    const { clientWidth, clientHeight } = this.chart;
    this.drawn?.setSize({ width: clientWidth, height: Math.max(clientHeight - legendHeight(this.chart), 60) });
  }

  close(): void {
    this.stop();
    for (const curve of this.curves) curve.stop();
    this.drawn?.destroy();
  }

  private add(path: string): void {
    const series = new Series();
    const stop = this.context.robot.subscriptions.watch(
      { path },
      {
        sample: ({ time, value }) => {
          series.add(time / 1e9, height(value));
          this.draw();
        },
        refused: (reason) => complain(this.failure, reason === null ? null : `${path}: ${reason}`),
      },
    );
    this.curves.push({ path, series, stop });
  }

  private drop(curve: Curve): void {
    curve.stop();
    this.curves.splice(this.curves.indexOf(curve), 1);
    complain(this.failure, null);
    this.rebuild();
    this.save();
  }

  private save(): void {
    this.context.save({ paths: this.curves.map((curve) => curve.path), window: this.window });
  }

  private rebuild(): void {
    this.context.title(this.curves.map((curve) => nameOf(curve.path)).join(", "));
    this.chips.replaceChildren(
      ...this.curves.map((curve, at) => {
        const swatch = make("span", { class: "swatch" });
        swatch.style.background = color(at);
        const gone = button("×", `remove ${curve.path}`, () => this.drop(curve), "plain");
        return make("span", { class: "chip", title: curve.path }, swatch, shortly(curve.path), gone);
      }),
      this.input,
    );
    this.drawn?.destroy();
    this.chart.classList.toggle("unused", this.curves.length === 0);
    const ink = getComputedStyle(document.body).getPropertyValue("--faint");
    const line = getComputedStyle(document.body).getPropertyValue("--rule");
    const font = `${getComputedStyle(document.body).getPropertyValue("--small")} system-ui, sans-serif`;
    const axis = { font, stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 } };
    const options: uPlot.Options = {
      width: Math.max(this.chart.clientWidth, 100),
      height: Math.max(this.chart.clientHeight - 30, 60),
      scales: { x: { time: false } },
      axes: [{ ...axis, values: (_, ticks) => ticks.map((tick) => `${short(tick)} s`) }, { ...axis, size: 64, values: (_, ticks) => ticks.map(short) }],
      cursor: { drag: { x: true, y: false, setScale: false } },
      series: [
        { label: "time", value: (_, time) => (time === null ? "–" : `${time.toFixed(3)} s`) },
        ...this.curves.map((curve, at) => curveOf(nameOf(curve.path), color(at), [])),
        ...this.compared().map((curve) => curveOf(`${nameOf(curve.path)} of the other run`, color(this.curves.indexOf(curve)), [4, 4])),
      ],
      hooks: { setSelect: [(chart) => this.zoom(chart)] },
    };
    this.drawn = new uPlot(options, this.shown() as uPlot.AlignedData, this.chart);
    requestAnimationFrame(() => this.resized());
  }

  /** The newest time of all curves: instances without a value for a while do not hold the others back. */
  private newest(): number {
    return Math.max(0, ...this.curves.map(({ series }) => series.times[series.times.length - 1] ?? 0));
  }

  private range(): [number, number] {
    return this.held ?? [this.newest() - this.window, this.newest()];
  }

  private shown(): ReturnType<typeof align> {
    const others = this.compared().map(({ path }) => this.others.get(path) as Series);
    return align([...this.curves.map((curve) => curve.series), ...others], ...this.range());
  }

  /** Curves that the other run has, too. */
  private compared(): Curve[] {
    return this.curves.filter(({ path }) => this.others.has(path));
  }

  private update(): void {
    const chart = this.drawn;
    if (chart === null || this.held !== null) return;
    const [min, max] = this.range();
    chart.batch(() => {
      chart.setData(this.shown() as uPlot.AlignedData, false);
      chart.setScale("x", { min, max });
    });
  }

  private hold(): void {
    if (this.held !== null) this.go();
    else this.show(this.range());
  }

  private zoom(chart: uPlot): void {
    const { left, width } = chart.select;
    if (width < 5) return;
    const range: [number, number] = [chart.posToVal(left, "x"), chart.posToVal(left + width, "x")];
    chart.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.show(range);
  }

  private show(range: [number, number]): void {
    this.held = range;
    this.pause.textContent = "Go on";
    this.drawn?.batch(() => {
      this.drawn?.setData(this.shown() as uPlot.AlignedData, false);
      this.drawn?.setScale("x", { min: range[0], max: range[1] });
    });
  }

  private go(): void {
    this.held = null;
    this.pause.textContent = "Pause";
    this.update();
  }

  private export(): void {
    const [times, ...all] = this.shown();
    const columns = all.slice(0, this.curves.length);
    const head = ["time", ...this.curves.map((curve) => curve.path)].join(",");
    const rows = times.map((time, row) => [time, ...columns.map((column) => column[row] ?? "")].join(","));
    download("plot.csv", `${[head, ...rows].join("\n")}\n`, "text/csv");
  }
}

function curveOf(label: string, stroke: string, dash: number[]): uPlot.Series {
  const value = (_: uPlot, value: number | null): string => (value === null || value === undefined ? "–" : number(value));
  return { label, stroke, dash, width: dash.length > 0 ? 2 : 1.5, spanGaps: dash.length > 0, points: { show: false }, value };
}

/** Opens curves that another plot has saved, of another run over the same seconds. */
function compare(deed: (others: Map<string, Series>) => void, failure: HTMLElement): HTMLElement {
  const file = make("input", { type: "file", accept: ".csv,text/csv", hidden: true, "aria-label": "curves of another run" });
  file.addEventListener("change", () => {
    void file.files?.[0]?.text().then((text) => {
      const others = readCurves(text);
      complain(failure, others.size === 0 ? "this file has no curves: save some with CSV" : null);
      deed(others);
      file.value = "";
    });
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

function color(at: number): string {
  return COLORS[at % COLORS.length] as string;
}

function legendHeight(chart: HTMLElement): number {
  return chart.querySelector<HTMLElement>(".u-legend")?.offsetHeight ?? 0;
}

export const plot: PanelKind = { kind: "plot", name: "Plot", open: (context) => new Plot(context) };
