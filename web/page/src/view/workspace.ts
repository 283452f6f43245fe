// The panels of the layout, in columns: moved by their heads, resized at the lines between them.
import { KINDS } from "../panels/kinds";
import { DRAGGED_PATH, type Panel, type PanelKind } from "../panels/panel";
import { robotChoice, robotColor, robotMark } from "../panels/series";
import type { Arrangement, Layout, PanelPlace, Settings, Spot } from "../store/layout";
import type { Known, Robots } from "../store/robots";
import { button, make, select } from "./dom";

const DRAGGED_PANEL = "application/x-hulk-panel";

interface Opened {
  frame: HTMLElement;
  panel: Panel | null;
  watch: ResizeObserver;
  stop(): void;
}

export class Workspace {
  readonly element = make("main", { class: "workspace" });
  private readonly opened = new Map<string, Opened>();

  constructor(
    private readonly robots: Robots,
    private readonly arrangement: Arrangement,
  ) {
    let isFirst = true;
    robots.known.watch(() => {
      // Panels have to know of all of them.
      if (!isFirst) this.closeAll();
      isFirst = false;
      this.draw(arrangement.layout.value);
    });
    let isDrawn = false;
    arrangement.layout.watch((layout) => {
      if (isDrawn) this.draw(layout);
      isDrawn = true;
    });
  }

  private closeAll(): void {
    for (const id of [...this.opened.keys()]) this.close(id);
  }

  private close(id: string): void {
    const opened = this.opened.get(id);
    opened?.watch.disconnect();
    opened?.stop();
    opened?.panel?.close();
    this.opened.delete(id);
  }

  private draw(layout: Layout): void {
    const wanted = new Set(layout.columns.flatMap((column) => column.panels.map((panel) => panel.id)));
    for (const id of [...this.opened.keys()]) if (!wanted.has(id)) this.close(id);
    const columns = layout.columns.flatMap((column, at) => {
      const frames = column.panels.flatMap((place, row) => {
        const { frame } = this.opened.get(place.id) ?? this.open(place);
        frame.style.flexGrow = String(place.size);
        frame.dataset["column"] = String(at);
        frame.dataset["row"] = String(row);
        return row === 0 ? [frame] : [this.line({ column: at, row: row - 1 }), frame];
      });
      const element = make("div", { class: "column" }, ...frames);
      element.style.flexGrow = String(column.size);
      return at === 0 ? [element] : [this.line({ column: at - 1, row: null }), element];
    });
    const end = this.edge(layout.columns.length);
    this.element.replaceChildren(...columns, end);
    if (layout.columns.length === 0) this.element.append(make("p", { class: "muted empty" }, "Nothing is shown: add a panel, or choose a path."));
  }

  private open(place: PanelPlace): Opened {
    const kind = KINDS.find((one) => one.kind === place.kind);
    const title = make("span", { class: "muted subject" });
    const head = make("div", { class: "head", draggable: "true", tabindex: "0", title: "drag it, or Alt and arrow keys, to move the panel" }, make("h2", {}, kind?.name ?? place.kind), title);
    const frame = make("section", { class: "panel", "data-kind": place.kind, "aria-label": kind?.name ?? place.kind }, head);
    const known = this.robots.find(place.robot);
    const panel = known === null ? null : this.panel(kind, known, place, title);
    const close = button("×", "close this panel", () => this.arrangement.remove(place.id), "plain");
    head.append(make("span", { class: "space" }), ...this.whose(place, known, frame), ...(panel?.tools ?? []), close);
    const missing = known === null ? `${place.robot} is not among the robots that this page may show: choose another one, or start this page's robot with --peer ${place.robot}` : "this page does not have this panel";
    frame.append(panel?.content ?? make("p", { class: "muted" }, missing));
    head.addEventListener("dragstart", (event) => event.dataTransfer?.setData(DRAGGED_PANEL, place.id));
    head.addEventListener("keydown", (event) => this.shift(place.id, frame, event));
    this.receive(frame, panel);
    const watch = new ResizeObserver(() => panel?.resized?.());
    watch.observe(frame);
    const stop = known?.robot.state.watch((state) => frame.classList.toggle("is-lost", state !== "open")) ?? (() => undefined);
    const opened = { frame, panel, watch, stop };
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
  private whose(place: PanelPlace, shown: Known | null, frame: HTMLElement): HTMLElement[] {
    const all = this.robots.known.value;
    if (all.length < 2 && shown !== null) return [];
    const names = all.map(robotChoice);
    const chosen = shown === null ? "no robot" : robotChoice(shown);
    if (shown !== null) {
      frame.dataset["robot"] = robotMark(shown.at);
      frame.style.setProperty("--robot", robotColor(shown.at));
    }
    const choices = shown === null ? [chosen, ...names] : names;
    const list = select(choices, chosen, "which robot this panel shows", (name) => {
      const known = all.find((one) => robotChoice(one) === name);
      if (known !== undefined) this.arrangement.assign(place.id, known.isOwn ? undefined : known.address);
    });
    list.classList.add("whose");
    return [list];
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
    frame.querySelector<HTMLElement>(".head")?.focus();
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
  private edge(column: number): HTMLElement {
    const edge = make("div", { class: "edge" });
    edge.addEventListener("dragover", (event) => {
      if (event.dataTransfer?.types.includes(DRAGGED_PANEL)) event.preventDefault();
    });
    edge.addEventListener("drop", (event) => {
      const id = event.dataTransfer?.getData(DRAGGED_PANEL);
      if (id) this.arrangement.move(id, { column, row: null });
    });
    return edge;
  }

  /** Between two neighbours: drag it to give one of them more place. */
  private line(spot: Spot): HTMLElement {
    const isBetweenColumns = spot.row === null;
    const line = make("div", { class: isBetweenColumns ? "divider upright" : "divider", role: "separator", tabindex: "0", "aria-label": "drag, or arrow keys, to resize", "aria-orientation": isBetweenColumns ? "vertical" : "horizontal" });
    line.addEventListener("keydown", (event) => {
      const by = (isBetweenColumns ? { ArrowLeft: -0.05, ArrowRight: 0.05 } : { ArrowUp: -0.05, ArrowDown: 0.05 })[event.key as never] as number | undefined;
      const [one, other] = [line.previousElementSibling, line.nextElementSibling];
      if (by === undefined || !(one instanceof HTMLElement) || !(other instanceof HTMLElement)) return;
      event.preventDefault();
      const sum = Number(one.style.flexGrow) + Number(other.style.flexGrow);
      const share = Math.min(Math.max(Number(one.style.flexGrow) / sum + by, 0.08), 0.92);
      one.style.flexGrow = String(sum * share);
      other.style.flexGrow = String(sum * (1 - share));
      const at = [...this.element.querySelectorAll(".divider")].indexOf(line);
      // Draws everything anew, with other lines at the same places.
      this.arrangement.resize(spot, [sum * share, sum * (1 - share)]);
      this.element.querySelectorAll<HTMLElement>(".divider")[at]?.focus();
    });
    line.addEventListener("pointerdown", (event) => {
      const [one, other] = [line.previousElementSibling, line.nextElementSibling];
      if (!(one instanceof HTMLElement) || !(other instanceof HTMLElement)) return;
      event.preventDefault();
      line.setPointerCapture(event.pointerId);
      const sum = Number(one.style.flexGrow) + Number(other.style.flexGrow);
      const [first, second] = [one.getBoundingClientRect(), other.getBoundingClientRect()];
      const begin = isBetweenColumns ? first.left : first.top;
      const end = isBetweenColumns ? second.right : second.bottom;
      const drag = (moved: PointerEvent): void => {
        const at = ((isBetweenColumns ? moved.clientX : moved.clientY) - begin) / (end - begin);
        const share = Math.min(Math.max(at, 0.08), 0.92);
        one.style.flexGrow = String(sum * share);
        other.style.flexGrow = String(sum * (1 - share));
      };
      const drop = (): void => {
        line.removeEventListener("pointermove", drag);
        this.arrangement.resize(spot, [Number(one.style.flexGrow), Number(other.style.flexGrow)]);
      };
      line.addEventListener("pointermove", drag);
      line.addEventListener("pointerup", drop, { once: true });
      line.addEventListener("pointercancel", drop, { once: true });
    });
    return line;
  }
}
