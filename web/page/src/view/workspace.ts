// The panels of the layout, in columns: moved by their heads, resized at the lines between them.
import { KINDS } from "../panels/kinds";
import { DRAGGED_PATH, type Panel, type PanelKind } from "../panels/panel";
import { robotChoice, robotColor, robotMark } from "../panels/series";
import type { Arrangement, Column, Layout, PanelPlace, Settings, Spot } from "../store/layout";
import type { Robot } from "../store/robot";
import type { Known, Robots } from "../store/robots";
import { button, make, select } from "./dom";
import { arrange } from "./renew";

const DRAGGED_PANEL = "application/x-hulk-panel";

interface Opened {
  frame: HTMLElement;
  /** Before it in its column, where it is not the first. */
  line: HTMLElement;
  /** Has the list of robots, where there are several. */
  choice: HTMLElement;
  panel: Panel | null;
  /** Null: the page may not show it. */
  robot: Robot | null;
  watch: ResizeObserver;
  stop(): void;
}

/** A column as it is drawn, and what is before it. */
interface Drawn {
  element: HTMLElement;
  line: HTMLElement;
}

export class Workspace {
  readonly element = make("main", { class: "workspace" });
  private readonly opened = new Map<string, Opened>();
  private columns = new Map<Column, Drawn>();
  private readonly edge = this.border();
  private readonly nothing = make("p", { class: "muted empty" }, "Nothing is shown: add a panel, or choose a path.");

  constructor(
    private readonly robots: Robots,
    private readonly arrangement: Arrangement,
  ) {
    robots.known.watch(() => {
      this.meet(arrangement.layout.value);
      this.draw(arrangement.layout.value);
    });
    let isDrawn = false;
    arrangement.layout.watch((layout) => {
      if (isDrawn) this.draw(layout);
      isDrawn = true;
    });
  }

  /** There are other robots than before: panels begin anew that show them, or whose own is another one. */
  private meet(layout: Layout): void {
    for (const place of layout.columns.flatMap(({ panels }) => panels)) {
      const opened = this.opened.get(place.id);
      if (opened === undefined) continue;
      const known = this.robots.find(place.robot);
      const isSame = known !== null && opened.robot === known.robot && kindOf(place)?.showsRobots !== true;
      if (isSame) this.mark(place, known, opened);
      else this.close(place.id);
    }
  }

  private close(id: string): void {
    const opened = this.opened.get(id);
    opened?.watch.disconnect();
    opened?.stop();
    opened?.panel?.close();
    this.opened.delete(id);
  }

  /** What stays where it is is not touched: it keeps what is typed, scrolled and pressed in it. */
  private draw(layout: Layout): void {
    const wanted = new Set(layout.columns.flatMap((column) => column.panels.map((panel) => panel.id)));
    for (const id of [...this.opened.keys()]) if (!wanted.has(id)) this.close(id);
    const restore = remember(this.element);
    const columns = new Map<Column, Drawn>();
    layout.columns.forEach((column, at) => {
      const drawn = this.columns.get(column) ?? { element: make("div", { class: "column" }), line: this.line(true) };
      columns.set(column, drawn);
      drawn.element.style.flexGrow = String(column.size);
      drawn.element.dataset["column"] = String(at);
      const frames = column.panels.flatMap((place, row) => {
        const { frame, line } = this.opened.get(place.id) ?? this.open(place);
        frame.style.flexGrow = String(place.size);
        frame.dataset["column"] = String(at);
        frame.dataset["row"] = String(row);
        return row === 0 ? [frame] : [line, frame];
      });
      arrange(drawn.element, frames);
    });
    this.columns = columns;
    const elements = [...columns.values()].flatMap(({ element, line }, at) => (at === 0 ? [element] : [line, element]));
    arrange(this.element, [...elements, this.edge, ...(elements.length === 0 ? [this.nothing] : [])]);
    restore();
  }

  private open(place: PanelPlace): Opened {
    const kind = kindOf(place);
    const title = make("span", { class: "muted subject" });
    const head = make("div", { class: "head", draggable: "true", tabindex: "0", title: "drag it, or Alt and arrow keys, to move the panel" }, make("h2", {}, kind?.name ?? place.kind), title);
    const frame = make("section", { class: "panel", "data-kind": place.kind, "aria-label": kind?.name ?? place.kind }, head);
    const known = this.robots.find(place.robot);
    const panel = known === null ? null : this.panel(kind, known, place, title);
    const close = button("×", "close this panel", () => this.arrangement.remove(place.id), "plain");
    const choice = make("span", { class: "choice" });
    head.append(make("span", { class: "space" }), choice, ...(panel?.tools ?? []), close);
    this.mark(place, known, { frame, choice });
    const missing = known === null ? `${place.robot} is not among the robots that this page may show: choose another one, or start this page's robot with --peer ${place.robot}` : "this page does not have this panel";
    frame.append(panel?.content ?? make("p", { class: "muted" }, missing));
    head.addEventListener("dragstart", (event) => event.dataTransfer?.setData(DRAGGED_PANEL, place.id));
    head.addEventListener("keydown", (event) => this.shift(place.id, frame, event));
    this.receive(frame, panel);
    const watch = new ResizeObserver(() => panel?.resized?.());
    watch.observe(frame);
    const robot = known?.robot ?? null;
    const stop = robot?.state.watch((state) => frame.classList.toggle("is-lost", state !== "open")) ?? (() => undefined);
    const opened = { frame, line: this.line(false), choice, panel, robot, watch, stop };
    this.opened.set(place.id, opened);
    return opened;
  }

  private panel(kind: PanelKind | undefined, known: Known, place: PanelPlace, title: HTMLElement): Panel | null {
    const context = {
      robot: known.robot,
      robots: this.robots.known.value,
      known,
      arrangement: this.arrangement,
      settings: place.settings,
      save: (settings: Settings) => this.arrangement.configure(place.id, settings),
      title: (text: string) => {
        title.replaceChildren(make("bdi", {}, text));
        title.title = text;
      },
    };
    return kind?.open(context) ?? null;
  }

  /** Where there are several robots: which one the panel shows, by colour, letter and address. */
  private mark(place: PanelPlace, shown: Known | null, { frame, choice }: Pick<Opened, "frame" | "choice">): void {
    const all = this.robots.known.value;
    const isAlone = all.length < 2 && shown !== null;
    if (isAlone || shown === null) delete frame.dataset["robot"];
    else {
      frame.dataset["robot"] = robotMark(shown.at);
      frame.style.setProperty("--robot", robotColor(shown.at));
    }
    choice.replaceChildren(...(isAlone ? [] : [this.whose(place, shown, all)]));
  }

  private whose(place: PanelPlace, shown: Known | null, all: readonly Known[]): HTMLElement {
    const names = all.map(robotChoice);
    const chosen = shown === null ? "no robot" : robotChoice(shown);
    const choices = shown === null ? [chosen, ...names] : names;
    const list = select(choices, chosen, "which robot this panel shows", (name) => {
      const known = all.find((one) => robotChoice(one) === name);
      if (known !== undefined) this.arrangement.assign(place.id, known.isOwn ? undefined : known.address);
    });
    list.classList.add("whose");
    return list;
  }

  /** The keyboard's way to move a panel: within its column, or into the next one. */
  private shift(id: string, frame: HTMLElement, event: KeyboardEvent): void {
    const [column, row] = [Number(frame.dataset["column"]), Number(frame.dataset["row"])];
    const spots: Record<string, Spot> = {
      ArrowUp: { column, row: row - 1 },
      ArrowDown: { column, row: row + 2 },
      ArrowLeft: { column: column - 1, row: 0 },
      ArrowRight: { column: column + 1, row: 0 },
    };
    const spot = spots[event.key];
    if (!event.altKey || spot === undefined || spot.column < 0 || (spot.row ?? 0) < 0) return;
    event.preventDefault();
    this.arrangement.move(id, spot);
  }

  /** Takes paths for the panel, and panels for the places around it. */
  private receive(frame: HTMLElement, panel: Panel | null): void {
    frame.addEventListener("dragover", (event) => {
      const types = event.dataTransfer?.types ?? [];
      if (types.includes(DRAGGED_PANEL) || (types.includes(DRAGGED_PATH) && panel?.accept !== undefined)) {
        event.preventDefault();
        frame.classList.add("target");
      }
    });
    frame.addEventListener("dragleave", () => frame.classList.remove("target"));
    frame.addEventListener("drop", (event) => {
      event.preventDefault();
      frame.classList.remove("target");
      const path = event.dataTransfer?.getData(DRAGGED_PATH);
      if (path) panel?.accept?.(path);
      const id = event.dataTransfer?.getData(DRAGGED_PANEL);
      if (!id) return;
      const box = frame.getBoundingClientRect();
      const column = Number(frame.dataset["column"]);
      const below = event.clientY > box.top + box.height / 2 ? 1 : 0;
      this.arrangement.move(id, { column, row: Number(frame.dataset["row"]) + below });
    });
  }

  /** The right border: a panel that is dropped there gets a column of its own. */
  private border(): HTMLElement {
    const edge = make("div", { class: "edge" });
    edge.addEventListener("dragover", (event) => {
      if (event.dataTransfer?.types.includes(DRAGGED_PANEL)) event.preventDefault();
    });
    edge.addEventListener("drop", (event) => {
      const id = event.dataTransfer?.getData(DRAGGED_PANEL);
      if (id) this.arrangement.move(id, { column: this.columns.size, row: null });
    });
    return edge;
  }

  /** Between two neighbours: drag it to give one of them more place. */
  private line(isBetweenColumns: boolean): HTMLElement {
    const line = make("div", { class: isBetweenColumns ? "divider upright" : "divider", role: "separator", tabindex: "0", "aria-label": "drag, or arrow keys, to resize", "aria-orientation": isBetweenColumns ? "vertical" : "horizontal" });
    const share = (one: HTMLElement, other: HTMLElement, wanted: number): void => {
      const sum = Number(one.style.flexGrow) + Number(other.style.flexGrow);
      const part = Math.min(Math.max(wanted, 0.08), 0.92);
      one.style.flexGrow = String(sum * part);
      other.style.flexGrow = String(sum * (1 - part));
    };
    const keep = (one: HTMLElement, other: HTMLElement): void => {
      const spot = { column: Number(one.dataset["column"]), row: isBetweenColumns ? null : Number(one.dataset["row"]) };
      this.arrangement.resize(spot, [Number(one.style.flexGrow), Number(other.style.flexGrow)]);
    };
    line.addEventListener("keydown", (event) => {
      const by = (isBetweenColumns ? { ArrowLeft: -0.05, ArrowRight: 0.05 } : { ArrowUp: -0.05, ArrowDown: 0.05 })[event.key as never] as number | undefined;
      const [one, other] = [line.previousElementSibling, line.nextElementSibling];
      if (by === undefined || !(one instanceof HTMLElement) || !(other instanceof HTMLElement)) return;
      event.preventDefault();
      share(one, other, Number(one.style.flexGrow) / (Number(one.style.flexGrow) + Number(other.style.flexGrow)) + by);
      keep(one, other);
    });
    line.addEventListener("pointerdown", (event) => {
      const [one, other] = [line.previousElementSibling, line.nextElementSibling];
      if (!(one instanceof HTMLElement) || !(other instanceof HTMLElement)) return;
      event.preventDefault();
      line.setPointerCapture(event.pointerId);
      const [first, second] = [one.getBoundingClientRect(), other.getBoundingClientRect()];
      const begin = isBetweenColumns ? first.left : first.top;
      const end = isBetweenColumns ? second.right : second.bottom;
      const drag = (moved: PointerEvent): void => {
        share(one, other, ((isBetweenColumns ? moved.clientX : moved.clientY) - begin) / (end - begin));
      };
      const drop = (): void => {
        line.removeEventListener("pointermove", drag);
        keep(one, other);
      };
      line.addEventListener("pointermove", drag);
      line.addEventListener("pointerup", drop, { once: true });
      line.addEventListener("pointercancel", drop, { once: true });
    });
    return line;
  }
}

function kindOf(place: PanelPlace): PanelKind | undefined {
  return KINDS.find((one) => one.kind === place.kind);
}

/** What is scrolled, and what has the focus: elements lose both where they are put elsewhere, until what it returns is called. */
function remember(element: HTMLElement): () => void {
  const focused = document.activeElement;
  const scrolled = [...element.querySelectorAll("*")].flatMap((one) => {
    const { scrollTop, scrollLeft } = one;
    return scrollTop === 0 && scrollLeft === 0 ? [] : [{ one, scrollTop, scrollLeft }];
  });
  return () => {
    for (const { one, scrollTop, scrollLeft } of scrolled) Object.assign(one, { scrollTop, scrollLeft });
    const isLost = focused instanceof HTMLElement && focused !== document.activeElement && element.contains(focused);
    if (isLost) focused.focus({ preventScroll: true });
  };
}
