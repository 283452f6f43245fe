// One cycle of one instance: its nodes as long as they took, beside each other in the order of their calls.
import { trace, type Lane, type Span } from "../store/trace";
import type { Robot } from "../store/robot";
import { button, complain, make } from "../view/dom";
import { microseconds } from "../view/format";
import { COLORS } from "./series";

/** Enough for a cycle of the slowest instance to have ended. */
const SECONDS = 1;

export class Flame {
  readonly element: HTMLElement;
  private readonly choice = make("select", { "aria-label": "instance" });
  private readonly about = make("output", { class: "muted" });
  private readonly rows = make("div", { class: "flame" });
  private readonly failure = make("p", { class: "failure", hidden: true });
  private lanes: Lane[] = [];

  constructor(private readonly robot: Robot) {
    this.choice.addEventListener("change", () => this.draw(false));
    const bar = make(
      "div",
      { class: "bar" },
      this.choice,
      button("Newest", "the newest cycle", () => void this.ask(false)),
      button("Slowest", "the slowest cycle of the last second", () => void this.ask(true)),
      this.about,
    );
    this.element = make("section", { class: "flames", hidden: true }, bar, this.failure, this.rows);
  }

  toggle(): void {
    this.element.hidden = !this.element.hidden;
    if (!this.element.hidden) void this.ask(false);
  }

  private async ask(isSlowest: boolean): Promise<void> {
    try {
      this.lanes = (await trace(this.robot, SECONDS)).filter((lane) => lane.spans.some((span) => span.isCycle));
      complain(this.failure, null);
    } catch (error) {
      complain(this.failure, error);
    }
    const chosen = this.choice.value;
    const most = [...this.lanes].sort((one, other) => other.spans.length - one.spans.length)[0]?.instance ?? "";
    this.choice.replaceChildren(...this.lanes.map(({ instance }) => make("option", { value: instance, selected: instance === (chosen === "" ? most : chosen) }, instance)));
    this.draw(isSlowest);
  }

  private draw(isSlowest: boolean): void {
    const lane = this.lanes.find(({ instance }) => instance === this.choice.value);
    const cycles = lane?.spans.filter((span) => span.isCycle) ?? [];
    const cycle = isSlowest ? [...cycles].sort((one, other) => other.duration - one.duration)[0] : cycles.at(-1);
    if (lane === undefined || cycle === undefined) return;
    const end = cycle.begin + cycle.duration;
    const nodes = lane.spans.filter((span) => !span.isCycle && span.begin >= cycle.begin && span.begin + span.duration <= end + 1);
    const inside = nodes.reduce((sum, node) => sum + node.duration, 0);
    this.about.textContent = `cycle ${cycle.cycle ?? "?"}: ${microseconds(cycle.duration)}, of which ${microseconds(cycle.duration - inside)} framework`;
    this.rows.replaceChildren(
      this.row([cycle], cycle, () => "var(--chosen)"),
      this.row(nodes, cycle, (at) => `${COLORS[at % COLORS.length]}`),
      make("ol", { class: "longest" }, ...[...nodes].sort((one, other) => other.duration - one.duration).slice(0, 8).map((node) => make("li", {}, `${microseconds(node.duration)}  ${node.name}`))),
    );
  }

  private row(spans: readonly Span[], cycle: Span, color: (at: number) => string): HTMLElement {
    const blocks = spans.map((span, at) => {
      const text = `${span.name}: ${microseconds(span.duration)}`;
      const block = make("span", { class: "block", title: text, tabindex: "0", "aria-label": text }, span.name.slice(span.name.lastIndexOf(":") + 1));
      block.style.left = `${(100 * (span.begin - cycle.begin)) / cycle.duration}%`;
      block.style.width = `${(100 * span.duration) / cycle.duration}%`;
      block.style.background = color(at);
      return block;
    });
    return make("div", { class: "flame-row" }, ...blocks);
  }
}
