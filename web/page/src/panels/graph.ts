// A panel with the robot's data-flow graph: nodes in the order in which they run, and what one of them reads and writes.
import { expect } from "../connection/socket";
import type { InstanceTimings, Welcome } from "../protocol";
import { isSameRun } from "../store/run";
import { alone, button, complain, make, wrapping } from "../view/dom";
import { microseconds } from "../view/format";
import { arrange } from "../view/renew";
import { DRAGGED_PATH, type Context, type Panel, type PanelKind } from "./panel";

/** The part of `hulkgen graph --format json`, version 1, that is drawn. */
interface Graph {
  cyclers: GraphCycler[];
  edges: { from: { cycler: string; node: string; output: string }; to: { cycler: string; node: string; field: string }; kind: string }[];
}

interface GraphCycler {
  name: string;
  kind: string;
  instances: string[];
  nodes: GraphNode[];
}

interface GraphNode {
  path: string;
  setup: boolean;
  order: number;
  file: string;
  fields: { context: string; name: string; kind: string; path: string | null; type?: string; line: number }[];
}

/** A node that is looked at. */
interface Chosen {
  key: string;
  cycler: GraphCycler;
  node: GraphNode;
}

/** A cycler as it is drawn. */
interface Section {
  element: HTMLElement;
  kind: HTMLElement;
  list: HTMLElement;
}

const PERIOD_MILLISECONDS = 1000;

/** Where the outputs of an instance stand, by the kind of the field that writes them. */
const FOLDERS: Record<string, string> = { MainOutput: "main_outputs", AdditionalOutput: "additional_outputs" };

class GraphPanel implements Panel {
  readonly content: HTMLElement;
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly flow = make("div", { class: "flow" });
  private readonly lanes = make("div", { class: "lanes" }, this.flow);
  private readonly about = make("aside", { class: "about", hidden: true });
  private readonly timings = make("div", { class: "muted" });
  private readonly search = make("input", { type: "search", placeholder: "search a node or value", "aria-label": "search a node or value" });
  private sections = new Map<string, Section>();
  private cards = new Map<string, HTMLElement>();
  private graph: Graph | null = null;
  /** Whose graph is drawn; null: nobody's, or what came last is not known. */
  private run: Welcome | null = null;
  private chosen: Chosen | null = null;
  private readonly ask = alone(() => this.time());
  private readonly timer = window.setInterval(() => this.ask(), PERIOD_MILLISECONDS);
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
    window.clearInterval(this.timer);
    this.stop();
  }

  private async load(): Promise<void> {
    const { robot } = this.context;
    const welcome = robot.welcome.value;
    // The graph of a program does not change.
    if (isSameRun(this.run, welcome) === true) return this.ask();
    try {
      this.graph = expect(await robot.ask({ graph: {} }), "graph") as unknown as Graph;
      this.draw(this.graph);
      this.run = welcome;
      complain(this.failure, null);
    } catch (error) {
      this.run = null;
      complain(this.failure, error);
    }
  }

  /** What another program has, too, is the same element, with its focus and the click that has begun. */
  private draw(graph: Graph): void {
    const [sections, cards] = [new Map<string, Section>(), new Map<string, HTMLElement>()];
    for (const cycler of graph.cyclers) {
      const section = this.sections.get(cycler.name) ?? sectionOf(cycler.name);
      sections.set(cycler.name, section);
      section.kind.textContent = `${cycler.kind.replace("_", "-")} · ${cycler.instances.join(", ")}`;
      const nodes = [...cycler.nodes].sort((one, other) => one.order - other.order);
      const items = nodes.map((node) => {
        const key = keyOf(cycler.name, node.path);
        const card = this.cards.get(key) ?? this.card(key, node.path);
        card.classList.toggle("setup", node.setup);
        cards.set(key, card);
        return card.parentElement ?? make("li", {}, card);
      });
      arrange(section.list, items);
    }
    arrange(this.flow, [...sections.values()].map(({ element }) => element));
    [this.sections, this.cards] = [sections, cards];
    this.choose(this.chosen?.key ?? null);
    this.mark();
  }

  private card(key: string, path: string): HTMLElement {
    const [group, name] = split(path);
    const card = make("button", { type: "button", class: "node", "aria-label": key, title: path }, make("span", { class: "muted" }, group), ...wrapping(name));
    card.addEventListener("click", () => this.choose(this.chosen?.key === key ? null : key));
    return card;
  }

  /** Shows what a node reads (marked `<`) and who reads it (marked `>`): by sign as well as by colour. */
  private choose(wanted: string | null): void {
    this.chosen = wanted === null ? null : this.find(wanted);
    const key = this.chosen?.key ?? null;
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
    if (this.chosen !== null) this.tell(this.chosen);
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

  /** The node, where there is such a one. */
  private find(key: string): Chosen | null {
    for (const cycler of this.graph?.cyclers ?? []) {
      const node = cycler.nodes.find((one) => keyOf(cycler.name, one.path) === key);
      if (node !== undefined) return { key, cycler, node };
    }
    return null;
  }

  private tell({ cycler, node }: Chosen): void {
    this.timings.replaceChildren();
    const fields = node.fields.map((field) => this.field(cycler.instances, field));
    const close = button("×", "close", () => this.choose(null), "plain");
    this.about.replaceChildren(
      make("div", { class: "bar" }, make("h3", {}, node.path), close),
      make("p", { class: "muted" }, `${node.file} · place ${node.order + 1} of ${cycler.nodes.length} in ${cycler.name}`),
      this.timings,
      make("ul", {}, ...fields),
    );
    this.ask();
  }

  /** Of the node that is chosen when the answer comes: it is of all of them. */
  private async time(): Promise<void> {
    const { robot } = this.context;
    if (this.chosen === null || document.hidden || robot.state.value !== "open") return;
    try {
      const { instances } = expect(await robot.ask({ timings: {} }), "timings");
      this.timings.replaceChildren(...timingsOf(this.chosen, instances));
    } catch (error) {
      this.timings.textContent = error instanceof Error ? error.message : String(error);
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

function sectionOf(name: string): Section {
  const [kind, list] = [make("p", { class: "muted" }), make("ol")];
  return { element: make("section", {}, make("h3", {}, name), kind, list), kind, list };
}

function timingsOf(chosen: Chosen | null, instances: readonly InstanceTimings[]): HTMLElement[] {
  if (chosen === null) return [];
  return instances.filter((one) => chosen.cycler.instances.includes(one.name)).map((one) => timing(one, chosen.node.path));
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
