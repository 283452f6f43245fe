// A panel with the robot's data-flow graph: nodes in the order in which they run, and what one of them reads and writes.
import { expect } from "../connection/socket";
import type { InstanceTimings } from "../protocol";
import { button, complain, make, wrapping } from "../view/dom";
import { microseconds } from "../view/format";
import { DRAGGED_PATH, type Context, type Panel, type PanelKind } from "./panel";

/** The part of `hulkgen graph --format json`, version 1, that is drawn. */
interface Graph {
  cyclers: { name: string; kind: string; instances: string[]; nodes: GraphNode[] }[];
  edges: { from: { cycler: string; node: string; output: string }; to: { cycler: string; node: string; field: string }; kind: string }[];
}

interface GraphNode {
  path: string;
  setup: boolean;
  order: number;
  file: string;
  fields: { context: string; name: string; kind: string; path: string | null; type?: string; line: number }[];
}

/** Where the outputs of an instance stand, by the kind of the field that writes them. */
const FOLDERS: Record<string, string> = { MainOutput: "main_outputs", AdditionalOutput: "additional_outputs" };

class GraphPanel implements Panel {
  readonly content: HTMLElement;
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly lanes = make("div", { class: "lanes" });
  private readonly about = make("aside", { class: "about", hidden: true });
  private readonly search = make("input", { type: "search", placeholder: "search a node or value", "aria-label": "search a node or value" });
  private readonly cards = new Map<string, HTMLElement>();
  private graph: Graph | null = null;
  private chosen: string | null = null;
  private readonly stop: () => void;

  constructor(private readonly context: Context) {
    this.content = make("div", { class: "graph" }, make("div", { class: "bar" }, this.search), this.failure, this.lanes, this.about);
    this.search.addEventListener("input", () => this.mark());
    this.content.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.choose(null);
    });
    this.stop = context.robot.state.watch((state) => {
      if (state === "open") void this.load();
    });
  }

  close(): void {
    this.stop();
  }

  private async load(): Promise<void> {
    try {
      this.graph = expect(await this.context.robot.ask({ graph: {} }), "graph") as unknown as Graph;
      this.draw(this.graph);
      complain(this.failure, null);
    } catch (error) {
      complain(this.failure, error);
    }
  }

  private draw(graph: Graph): void {
    this.cards.clear();
    const sections = graph.cyclers.map((cycler) => {
      const nodes = [...cycler.nodes].sort((one, other) => one.order - other.order);
      const cards = nodes.map((node) => this.card(cycler.name, node));
      const kind = make("p", { class: "muted" }, `${cycler.kind.replace("_", "-")} · ${cycler.instances.join(", ")}`);
      return make("section", {}, make("h3", {}, cycler.name), kind, make("ol", {}, ...cards));
    });
    this.lanes.replaceChildren(make("div", { class: "flow" }, ...sections));
    this.choose(this.chosen !== null && this.cards.has(this.chosen) ? this.chosen : null);
    this.mark();
  }

  private card(cycler: string, node: GraphNode): HTMLElement {
    const key = keyOf(cycler, node.path);
    const [group, name] = split(node.path);
    const card = make("button", { type: "button", class: node.setup ? "node setup" : "node", "aria-label": key, title: node.path }, make("span", { class: "muted" }, group), ...wrapping(name));
    card.addEventListener("click", () => this.choose(this.chosen === key ? null : key));
    this.cards.set(key, card);
    return make("li", {}, card);
  }

  /** Shows what a node reads (marked `<`) and who reads it (marked `>`): by sign as well as by colour. */
  private choose(key: string | null): void {
    this.chosen = key;
    const edges = this.graph?.edges ?? [];
    const reads = new Set(edges.filter((edge) => keyOf(edge.to.cycler, edge.to.node) === key).map((edge) => keyOf(edge.from.cycler, edge.from.node)));
    const readers = new Set(edges.filter((edge) => keyOf(edge.from.cycler, edge.from.node) === key).map((edge) => keyOf(edge.to.cycler, edge.to.node)));
    this.lanes.classList.toggle("choosing", key !== null);
    for (const [name, card] of this.cards) {
      card.classList.toggle("chosen", name === key);
      card.classList.toggle("read", reads.has(name));
      card.classList.toggle("reader", readers.has(name));
      card.setAttribute("aria-pressed", String(name === key));
    }
    this.about.hidden = key === null;
    if (key !== null) void this.tell(key);
  }

  private mark(): void {
    const words = this.search.value.trim().toLowerCase();
    for (const cycler of this.graph?.cyclers ?? []) {
      for (const node of cycler.nodes) {
        const text = `${node.path} ${node.fields.map((field) => field.name).join(" ")}`.toLowerCase();
        this.cards.get(keyOf(cycler.name, node.path))?.classList.toggle("found", words !== "" && text.includes(words));
      }
    }
    this.lanes.querySelector(".found")?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  private async tell(key: string): Promise<void> {
    const cycler = this.graph?.cyclers.find((one) => one.nodes.some((node) => keyOf(one.name, node.path) === key));
    const node = cycler?.nodes.find((one) => keyOf(cycler.name, one.path) === key);
    if (cycler === undefined || node === undefined) return;
    const timings = make("div", { class: "muted" });
    const fields = node.fields.map((field) => this.field(cycler.instances, field));
    const close = button("×", "close", () => this.choose(null), "plain");
    this.about.replaceChildren(
      make("div", { class: "bar" }, make("h3", {}, node.path), close),
      make("p", { class: "muted" }, `${node.file} · place ${node.order + 1} of ${cycler.nodes.length} in ${cycler.name}`),
      timings,
      make("ul", {}, ...fields),
    );
    try {
      const answer = expect(await this.context.robot.ask({ timings: {} }), "timings");
      const lines = answer.instances.filter((one) => cycler.instances.includes(one.name)).map((one) => timing(one, node.path));
      timings.replaceChildren(...lines);
    } catch (error) {
      timings.textContent = String(error);
    }
  }

  /** A field; outputs open a panel with their value. */
  private field(instances: readonly string[], field: GraphNode["fields"][number]): HTMLElement {
    const folder = FOLDERS[field.kind];
    const about = `${field.kind}${field.path === null || field.path === field.name ? "" : ` ${field.path}`}`;
    if (folder === undefined) return make("li", {}, make("span", { class: "name" }, field.name), make("span", { class: "muted" }, about));
    const links = instances.map((instance) => {
      const path = `${instance}.${folder}.${field.path ?? field.name}`;
      const text = instances.length > 1 ? `${field.name} of ${instance}` : field.name;
      const link = button(text, `show ${path}`, () => this.context.arrangement.add("value", { path }), "link");
      link.draggable = true;
      link.addEventListener("dragstart", (event) => event.dataTransfer?.setData(DRAGGED_PATH, path));
      return link;
    });
    return make("li", {}, ...links, make("span", { class: "muted" }, about));
  }
}

function timing(instance: InstanceTimings, path: string): HTMLElement {
  const node = instance.nodes.find((one) => one.node === path);
  if (node === undefined) return make("p", {}, `${instance.name}: no timings`);
  const durations = node.durations == null ? "" : `, p50 ${microseconds(node.durations.p50)}, p99 ${microseconds(node.durations.p99)}, max ${microseconds(node.durations.max)}`;
  return make("p", {}, `${instance.name}: ${node.calls} runs, ${node.skipped} skipped, ${node.failures} failed${durations}`);
}

function keyOf(cycler: string, node: string): string {
  return `${cycler} ${node}`;
}

function split(path: string): [string, string] {
  const at = path.lastIndexOf("::");
  return at < 0 ? ["", path] : [path.slice(0, at + 2), path.slice(at + 2)];
}

export const graph: PanelKind = { kind: "graph", name: "Graph", open: (context) => new GraphPanel(context) };
