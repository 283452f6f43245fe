// A panel with how long cycles and nodes take, as a table that follows the robot.
import { expect } from "../connection/socket";
import type { Durations, InstanceTimings, NodeTimings, Timings, Welcome } from "../protocol";
import { isSameRun } from "../store/run";
import { alone, button, download, make, wrapping } from "../view/dom";
import { Failures } from "../view/failures";
import { microseconds } from "../view/format";
import { renew } from "../view/renew";
import { Flame } from "./flame";
import type { Context, Panel, PanelKind } from "./panel";
import { type RecordedLine, recordedElsewhere, recordedOf } from "./recorded";

const PERIOD_MILLISECONDS = 1000;
/** Of instances p99 as a share of the deadline, of nodes p50 as a share of the cycle's. */
const HEAD = ["", "rate", "p50", "p99", "max", "share", "runs", "skip\u00adped", "failed", "over\u00adruns"];

function open(context: Context): Panel {
  let now: Timings | null = null;
  /** The answer before, of the same run: others count from their own beginning. */
  let before: Timings | null = null;
  let run: Welcome | null = null;
  const closed = new Set<string>();
  const failures = new Failures();
  const body = make("tbody");
  const head = make("tr", {}, ...HEAD.map((text) => make("th", { scope: "col" }, text)));
  const table = make("table", { class: "timings of-nodes" }, make("thead", {}, head), body);

  const draw = (): void => {
    const whole = now;
    if (whole === null) return;
    const instances = whole.instances.flatMap((instance) => keyed(instance.name, rows(instance, whole, before, closed, draw)));
    renew(body, [...instances, ...keyed("", recordedElsewhere(whole).map((one) => recordedLine(one, "instance")))]);
  };
  const ask = alone(async () => {
    if (context.robot.state.value !== "open" || document.hidden) return;
    try {
      const next = expect(await context.robot.ask({ timings: {} }), "timings");
      const welcome = context.robot.welcome.value;
      [now, before] = [next, isSameRun(run, welcome) === true ? now : null];
      run = welcome;
      draw();
      failures.asked(null);
    } catch (error) {
      failures.asked(error);
    }
  });
  const trace = button("Trace", "the last seconds as a file for ui.perfetto.dev", () => {
    context.robot
      .ask({ trace: { seconds: 10 } })
      .then((good) => {
        download("trace.json", JSON.stringify(expect(good, "trace")));
        failures.did(null);
      })
      .catch((error: unknown) => failures.did(error));
  });
  const timer = window.setInterval(ask, PERIOD_MILLISECONDS);
  const stop = context.robot.state.watch(ask);
  const close = (): void => {
    window.clearInterval(timer);
    stop();
  };
  const flame = new Flame(context.robot);
  const flames = button("Flame", "one cycle with its nodes", () => flame.toggle());
  return { content: make("div", { class: "scroll" }, failures.element, flame.element, table), tools: [flames, trace], close };
}

/** By which the next answer finds them. */
function keyed(owner: string, lines: readonly HTMLElement[]): readonly HTMLElement[] {
  lines.forEach((one, at) => one.setAttribute("data-key", `${owner} ${at}`));
  return lines;
}

function rows(instance: InstanceTimings, now: Timings, before: Timings | null, closed: Set<string>, draw: () => void): HTMLElement[] {
  const last = before?.instances.find((one) => one.name === instance.name);
  const elapsed = before === null ? 0 : (now.time - before.time) / 1e9;
  const rate = last === undefined || elapsed <= 0 ? "" : `${((instance.cycles - last.cycles) / elapsed).toFixed(1)} Hz`;
  const isClosed = closed.has(instance.name);
  const caret = button("", `nodes of ${instance.name}`, () => {
    if (!closed.delete(instance.name)) closed.add(instance.name);
    draw();
  }, isClosed ? "caret" : "caret open");
  const title = make("th", { scope: "row" }, make("span", { class: "whole" }, caret, instance.name));
  const deadline = instance.deadline ?? null;
  const share = deadline === null || instance.cycle == null ? "" : `${((100 * instance.cycle.p99) / deadline).toFixed(0)} %`;
  const numbers = [rate, ...durations(instance.cycle), share, instance.cycles, "", instance.failures, instance.overruns];
  const lines = [line(title, numbers, instance.overruns + instance.failures > 0 ? "instance bad" : "instance")];
  const recorded = recordedOf(now, instance.name);
  // What is missing is seen whatever else is.
  lines.push(...recorded.filter((one) => one.isMissing || !isClosed).map((one) => recordedLine(one, "node")));
  if (isClosed) return lines;
  const whole = instance.cycle?.p50 ?? 0;
  if (instance.lateness != null) lines.push(partLine("(late)", instance.lateness, 0, "from capture to begin"));
  for (const node of instance.nodes) lines.push(nodeLine(node, whole));
  if (instance.framework != null) lines.push(partLine("(framework)", instance.framework, whole, "what of a cycle is no node"));
  for (const queue of instance.queues) {
    const text = `from ${queue.from}: ${queue.delivered} delivered, ${queue.late} late, ${queue.dropped} dropped`;
    lines.push(make("tr", { class: "node" }, make("td", { colspan: HEAD.length, class: "muted" }, text)));
  }
  return lines;
}

function recordedLine({ text, isMissing }: RecordedLine, kind: string): HTMLElement {
  return make("tr", { class: isMissing ? `${kind} recorded bad` : `${kind} recorded` }, make("td", { colspan: HEAD.length, class: isMissing ? "" : "muted" }, text));
}

function nodeLine(node: NodeTimings, whole: number): HTMLElement {
  const name = make("td", { title: node.node }, ...wrapping(withoutCrate(node.node)));
  const numbers = ["", ...durations(node.durations), shareOf(node.durations, whole), node.calls, node.skipped, node.failures, ""];
  return line(name, numbers, node.failures > 0 ? "node bad" : "node");
}

/** A table has little place, and nodes of a cycler are mostly of one crate. */
function withoutCrate(path: string): string {
  return path.replace(/^\w+::/, "");
}

function partLine(name: string, part: Durations, whole: number, about: string): HTMLElement {
  return line(make("td", { class: "muted", title: about }, name), ["", ...durations(part), shareOf(part, whole), "", "", "", ""], "node");
}

function durations(of: Durations | null | undefined): string[] {
  return of == null ? ["", "", ""] : [of.p50, of.p99, of.max].map(microseconds);
}

function shareOf(of: Durations | null | undefined, whole: number): HTMLElement | string {
  if (of == null || whole <= 0) return "";
  const meter = make("meter", { min: 0, max: 1, value: Math.min(of.p50 / whole, 1), title: `${((100 * of.p50) / whole).toFixed(1)} % of the cycle's p50` });
  return meter;
}

function line(title: HTMLElement, cells: (string | number | HTMLElement)[], kind: string): HTMLElement {
  const content = cells.map((cell) => make("td", {}, cell instanceof HTMLElement ? cell : String(cell)));
  return make("tr", { class: kind }, title, ...content);
}

export const timings: PanelKind = { kind: "timings", name: "Timings", open };
