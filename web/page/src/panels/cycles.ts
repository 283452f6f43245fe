// A panel with the cycles of all instances on a time axis, and what of them one cycle of a consumer takes as persistent,
// what as transient, and what it does not wait for: beyond its horizon everything may still change.
import { expect } from "../connection/socket";
import type { Json } from "../protocol";
import { trace, type Lane, type Span } from "../store/trace";
import { alone, button, complain, eachFrame, make, select, sharp } from "../view/dom";
import { microseconds } from "../view/format";
import { numberSetting, textSetting, type Context, type Panel, type PanelKind } from "./panel";
import { COLORS } from "./series";

const PERIOD_MILLISECONDS = 700;
const WINDOWS = ["100 ms", "200 ms", "400 ms", "1000 ms"];
const ROW = 34;
const HEAD = 22;
const NAMES = 110;

/** What a consumer's cycle makes of a cycle that it has heard of. */
type Standing = "persistent" | "transient" | "pending";
const COLOR: Record<Standing, string> = { persistent: COLORS[2] as string, transient: COLORS[1] as string, pending: COLORS[3] as string };

const LETTER: Record<Standing, string> = { persistent: "P", transient: "T", pending: "…" };

class Cycles implements Panel {
  readonly content: HTMLElement;
  readonly tools: HTMLElement[];
  private readonly canvas = make("canvas", { class: "cycles", tabindex: "0", role: "img", "aria-label": "cycles on a time axis; arrow keys choose one" });
  private readonly about = make("output", { class: "muted" });
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly draw = eachFrame(() => this.paint());
  private readonly hold: HTMLButtonElement;
  private readonly timer: number;
  private window: number;
  private isHeld = false;
  private lanes: Lane[] = [];
  private readonly input: HTMLSelectElement;
  private inputs = new Map<string, Input>();
  /** Whether they are those of the program that runs: another one may have come. */
  private areKnown = false;
  private readonly stop: () => void;
  /** Begin of the consumer's cycle that is looked at; null: the newest of which everything is known. */
  private chosen: number | null = null;

  constructor(private readonly context: Context) {
    this.window = numberSetting(context.settings, "window", 200);
    this.hold = button("Pause", "hold the picture", () => {
      this.isHeld = !this.isHeld;
      this.hold.textContent = this.isHeld ? "Go on" : "Pause";
      if (!this.isHeld) this.chosen = null;
    });
    this.tools = [
      select(WINDOWS, `${this.window} ms`, "how much is shown", (choice) => {
        this.window = Number.parseFloat(choice);
        this.save();
        this.draw();
      }),
      this.hold,
    ];
    this.input = select([], "", "whose perception input is judged: each has a horizon of its own", () => {
      this.save();
      this.draw();
    });
    const key = (Object.keys(COLOR) as Standing[]).map((standing) => {
      const swatch = make("span", { class: "swatch" });
      swatch.style.background = COLOR[standing];
      return make("span", { class: "chip" }, swatch, standing);
    });
    this.content = make("div", { class: "timeline" }, make("div", { class: "bar chips" }, this.input, ...key, this.about), this.failure, this.canvas);
    this.canvas.addEventListener("pointerdown", (event) => this.choose(this.timeAt(event.offsetX)));
    this.canvas.addEventListener("keydown", (event) => this.step(event));
    this.stop = context.robot.welcome.watch(() => (this.areKnown = false));
    const ask = alone(() => this.ask());
    this.timer = window.setInterval(ask, PERIOD_MILLISECONDS);
    ask();
  }

  close(): void {
    window.clearInterval(this.timer);
    this.stop();
  }

  resized(): void {
    this.draw();
  }

  private async ask(): Promise<void> {
    const { robot } = this.context;
    if (this.isHeld || document.hidden || robot.state.value !== "open") return;
    try {
      if (!this.areKnown) this.know(inputsOf(expect(await robot.ask({ graph: {} }), "graph")));
      const lanes = await trace(robot, (1.5 * this.window + 200) / 1000);
      // Somebody may hold the picture while the robot answers.
      if (!this.isHeld) this.lanes = lanes.map(({ instance, spans }) => ({ instance, spans: spans.filter((span) => span.isCycle) }));
      complain(this.failure, null);
    } catch (error) {
      this.areKnown = false;
      complain(this.failure, error);
    }
    this.draw();
  }

  private know(inputs: Map<string, Input>): void {
    this.inputs = inputs;
    this.areKnown = true;
    const widest = [...inputs].sort(([, one], [, other]) => other.producers.length - one.producers.length)[0]?.[0] ?? "";
    const wanted = this.input.value === "" ? textSetting(this.context.settings, "input", widest) : this.input.value;
    const chosen = inputs.has(wanted) ? wanted : widest;
    this.input.replaceChildren(...[...inputs.keys()].map((name) => make("option", { value: name, selected: name === chosen }, name)));
  }

  private save(): void {
    this.context.save({ window: this.window, input: this.input.value });
  }

  /** Who has the input. */
  private consumer(): Lane | undefined {
    const consumers = this.inputs.get(this.input.value)?.consumers ?? [];
    return this.lanes.find((lane) => consumers.includes(lane.instance));
  }

  private end(): number {
    return Math.max(0, ...this.lanes.flatMap(({ spans }) => spans.slice(-1).map((span) => span.begin + span.duration)));
  }

  private timeAt(x: number): number {
    const width = this.canvas.clientWidth - NAMES;
    return this.end() - (1 - (x - NAMES) / width) * this.window * 1000;
  }

  /** The cycle that began last before this time. */
  private choose(time: number): void {
    const cycle = this.consumer()?.spans.findLast((span) => span.begin <= time);
    if (cycle === undefined) return;
    if (!this.isHeld) this.hold.click();
    this.chosen = cycle.begin;
    this.draw();
  }

  private step(event: KeyboardEvent): void {
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    const spans = this.consumer()?.spans ?? [];
    const at = spans.indexOf(this.looked() as Span);
    const next = by === undefined ? undefined : spans[at + by];
    if (next === undefined) return;
    event.preventDefault();
    this.choose(next.begin);
  }

  /** The consumer's cycle that is looked at. What runs now is in no trace yet, so it lies a little back. */
  private looked(): Span | undefined {
    const spans = this.consumer()?.spans ?? [];
    const latest = this.end() - this.window * 350;
    return spans.find((span) => span.begin === this.chosen) ?? spans.findLast((span) => span.begin <= latest);
  }

  private paint(): void {
    const { canvas, lanes } = this;
    const [width, height] = [canvas.clientWidth, Math.max(HEAD + lanes.length * ROW, 60)];
    canvas.style.height = `${height}px`;
    const context = sharp(canvas);
    if (context === null) return;
    context.clearRect(0, 0, width, height);
    const style = getComputedStyle(document.body);
    const [ink, faint, rule] = ["--ink", "--faint", "--rule"].map((name) => style.getPropertyValue(name)) as [string, string, string];
    const begin = this.end() - this.window * 1000;
    const toX = (time: number): number => NAMES + ((time - begin) / (this.window * 1000)) * (width - NAMES);
    this.paintAxis(context, width, height, faint, rule);
    const looked = this.looked();
    const standings = looked === undefined ? null : judge(looked.begin, lanes, this.inputs.get(this.input.value)?.producers ?? []);
    lanes.forEach((lane, row) => {
      const top = HEAD + row * ROW;
      context.fillStyle = ink;
      context.textAlign = "left";
      context.fillText(lane.instance, 6, top + ROW / 2 + 4, NAMES - 10);
      context.save();
      context.beginPath();
      context.rect(NAMES, top, width - NAMES, ROW);
      context.clip();
      for (const span of lane.spans) this.paintSpan(context, span, [toX(span.begin), toX(span.begin + span.duration), top + 6], standings?.of.get(span) ?? null, span === looked ? ink : faint);
      context.restore();
    });
    if (looked === undefined || standings === null) return;
    upright(context, toX(looked.begin), height, ink, []);
    if (standings.horizon !== null) upright(context, toX(standings.horizon), height, COLOR.pending, [4, 4]);
    this.tell(looked, standings);
  }

  private paintAxis(context: CanvasRenderingContext2D, width: number, height: number, faint: string, rule: string): void {
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "center";
    // A phone has no place for all of them.
    const labelled = width - NAMES < 320 ? 2 : 1;
    for (let part = 0; part <= 4; part++) {
      const x = NAMES + (part / 4) * (width - NAMES);
      upright(context, x, height, rule, []);
      if (part % labelled !== 0) continue;
      context.fillStyle = faint;
      context.fillText(part === 4 ? "0 ms" : `−${((1 - part / 4) * this.window).toFixed(0)} ms`, Math.min(x, width - 24), 14);
    }
  }

  private paintSpan(context: CanvasRenderingContext2D, span: Span, [left, right, top]: [number, number, number], standing: Standing | null, line: string): void {
    const [width, height] = [Math.max(right - left, 3), ROW - 12];
    context.fillStyle = standing === null ? `${line}55` : COLOR[standing];
    if (standing === "pending") context.globalAlpha = 0.35;
    context.fillRect(left, top, width, height);
    context.globalAlpha = 1;
    if (right < NAMES) return;
    context.strokeStyle = standing === null ? line : COLOR[standing];
    context.lineWidth = standing === null ? 1 : 2;
    context.strokeRect(left, top, width, height);
    // A letter, for those who do not see the colours apart.
    context.fillStyle = line;
    context.textAlign = "left";
    if (standing !== null) context.fillText(LETTER[standing], left + width + 3, top + 15);
    else if (width > 40) context.fillText(`#${span.cycle ?? ""}`, left + 4, top + 15);
  }

  private tell(looked: Span, { of, horizon }: Judgement): void {
    const count = (standing: Standing): number => [...of.values()].filter((one) => one === standing).length;
    const far = horizon === null ? "nothing is pending" : `horizon ${microseconds(looked.begin - horizon)} back`;
    const counts = `${count("persistent")} persistent, ${count("transient")} transient, ${count("pending")} pending`;
    this.about.textContent = `${looked.name} #${looked.cycle ?? "?"}: ${counts}; ${far}`;
  }
}

interface Judgement {
  of: Map<Span, Standing>;
  /** Begin of the oldest cycle that is still pending. */
  horizon: number | null;
}

/** What a cycle that begins now makes of the cycles of others, by their begins and ends. */
function judge(now: number, lanes: readonly Lane[], consumed: readonly string[]): Judgement {
  const heard = lanes.filter((lane) => consumed.includes(lane.instance)).flatMap((lane) => lane.spans.filter((span) => span.begin <= now));
  const pending = heard.filter((span) => span.begin + span.duration > now);
  const horizon = pending.length === 0 ? null : Math.min(...pending.map((span) => span.begin));
  const standing = (span: Span): Standing => {
    if (span.begin + span.duration > now) return "pending";
    return horizon === null || span.begin < horizon ? "persistent" : "transient";
  };
  return { of: new Map(heard.map((span) => [span, standing(span)])), horizon };
}

/** Instances that have an input in order of time, and those whose cycles come with it. */
interface Input {
  consumers: string[];
  producers: string[];
}

/** The part of `hulkgen graph --format json`, version 1, that is needed. */
interface Graph {
  cyclers: { name: string; instances: string[] }[];
  edges: { from: { instance?: string }; to: { cycler: string; node: string; field: string }; kind: string }[];
}

/** By node and field. */
function inputsOf(answer: Json): Map<string, Input> {
  const { cyclers, edges } = answer as unknown as Graph;
  const inputs = new Map<string, Input>();
  for (const { from, to, kind } of edges) {
    if (kind !== "perception" || from.instance === undefined) continue;
    const name = `${to.node.slice(to.node.lastIndexOf(":") + 1)}.${to.field}`;
    const input = inputs.get(name) ?? { consumers: cyclers.find((cycler) => cycler.name === to.cycler)?.instances ?? [], producers: [] };
    input.producers.push(from.instance);
    inputs.set(name, input);
  }
  return inputs;
}

function upright(context: CanvasRenderingContext2D, x: number, height: number, color: string, dash: number[]): void {
  context.strokeStyle = color;
  context.lineWidth = 1;
  context.setLineDash(dash);
  context.beginPath();
  context.moveTo(x, HEAD - 4);
  context.lineTo(x, height);
  context.stroke();
  context.setLineDash([]);
}

export const cycles: PanelKind = { kind: "cycles", name: "Cycles", open: (context) => new Cycles(context) };
