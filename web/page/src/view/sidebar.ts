// The list of the robot's paths: levels are asked for when they are opened, everything when somebody searches.
import { KINDS } from "../panels/kinds";
import { DRAGGED_PATH } from "../panels/panel";
import type { Entry, Welcome } from "../protocol";
import type { Arrangement } from "../store/layout";
import { isImage, isNumber, nameOf } from "../store/paths";
import type { Robot } from "../store/robot";
import { isSameRun } from "../store/run";
import { button, complain, make } from "./dom";
import { arrange } from "./renew";

/** More matches are no help. */
const FOUND = 200;

/** An entry of the tree as it is drawn, as long as the robot says the same of it. */
interface Row {
  said: string;
  element: HTMLElement;
  fill(): Promise<void>;
}

export class Sidebar {
  readonly element: HTMLElement;
  private readonly list = make("ul", { class: "paths", role: "tree", "aria-label": "paths" });
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly search = make("input", { type: "search", placeholder: "search all paths  ( / )", "aria-label": "search all paths" });
  private readonly open = new Set<string>();
  private readonly rows = new Map<string, Row>();
  /** The line with what can be done with its value, and its path, which has another line when the list is made anew. */
  private selected: { path: string; line: HTMLElement } | null = null;
  private searches = 0;
  /** Whose paths are shown; null: nobody's, or not all of them came. */
  private run: Welcome | null = null;

  constructor(
    private readonly robot: Robot,
    private readonly arrangement: Arrangement,
  ) {
    this.element = make("nav", { class: "sidebar", "aria-label": "paths of the robot" }, make("div", { class: "bar" }, this.search), this.failure, this.list);
    this.search.addEventListener("input", () => {
      this.select(null);
      void this.refresh();
    });
    document.addEventListener("keydown", (event) => {
      if (event.key !== "/" || event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement) return;
      event.preventDefault();
      this.search.focus();
    });
    robot.welcome.watch((welcome) => {
      // The paths of a program do not change.
      if (welcome !== null && isSameRun(this.run, welcome) !== true) void this.refresh();
    });
  }

  private async refresh(): Promise<void> {
    const turn = ++this.searches;
    const welcome = this.robot.welcome.value;
    const words = this.search.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    try {
      const rows = words.length === 0 ? await this.level("") : await this.found(words);
      if (turn !== this.searches) return;
      arrange(this.list, rows);
      this.run = welcome;
      complain(this.failure, null);
    } catch (error) {
      if (turn === this.searches) this.fail(error);
    }
  }

  /** With the next connection it is asked for again. */
  private fail(error: unknown): void {
    this.run = null;
    complain(this.failure, error);
  }

  private async level(path: string): Promise<HTMLElement[]> {
    const entries = await this.robot.paths.below(path);
    return Promise.all(entries.map((entry) => this.row(entry)));
  }

  private async found(words: readonly string[]): Promise<HTMLElement[]> {
    const all = await this.robot.paths.everything();
    const matches = all.filter((entry) => words.every((word) => entry.path.toLowerCase().includes(word)));
    // What is named so itself comes before what lies below it.
    const last = words[words.length - 1] ?? "";
    matches.sort((one, other) => Number(nameOf(other.path).toLowerCase().includes(last)) - Number(nameOf(one.path).toLowerCase().includes(last)));
    const rows = matches.slice(0, FOUND).map((entry) => make("li", {}, this.line(entry, entry.path, null)));
    if (matches.length > FOUND) rows.push(make("li", { class: "muted" }, `and ${matches.length - FOUND} more`));
    if (matches.length === 0) rows.push(make("li", { class: "muted" }, "nothing has this name"));
    return rows;
  }

  /** What another program says the same of is the same element, with its focus and the click that has begun. */
  private async row(entry: Entry): Promise<HTMLElement> {
    const said = JSON.stringify(entry);
    const there = this.rows.get(entry.path);
    const row = there?.said === said ? there : this.newRow(entry, said);
    this.rows.set(entry.path, row);
    if (entry.has_children && this.open.has(entry.path)) await row.fill();
    return row.element;
  }

  private newRow(entry: Entry, said: string): Row {
    const list = make("ul", { role: "group" });
    const fill = async (): Promise<void> => arrange(list, await this.level(entry.path));
    const caret = button("", `open ${entry.path}`, () => toggle(), "caret");
    const show = (): void => {
      const isOpen = this.open.has(entry.path);
      list.hidden = !isOpen;
      caret.classList.toggle("open", isOpen);
      caret.setAttribute("aria-expanded", String(isOpen));
    };
    const toggle = (): void => {
      if (!this.open.delete(entry.path)) {
        this.open.add(entry.path);
        fill().catch((error: unknown) => this.fail(error));
      }
      show();
    };
    show();
    const element = make("li", { role: "treeitem" }, this.line(entry, nameOf(entry.path), entry.has_children ? caret : null, toggle), list);
    return { said, element, fill };
  }

  private line(entry: Entry, text: string, caret: HTMLElement | null, toggle?: () => void): HTMLElement {
    const isValue = entry.kind !== "folder" && entry.kind !== "procedure" && entry.kind !== "message";
    const name = make("button", { type: "button", class: "name", title: [entry.path, entry.type, entry.documentation].filter((part) => part != null).join("\n") }, text);
    const type = make("span", { class: "muted type" }, [entry.type ?? "", entry.unit ?? ""].filter((part) => part !== "").join(" "));
    const line = make("div", { class: "line", "data-path": entry.path }, caret ?? make("span", { class: "caret leaf" }), name, type);
    name.addEventListener("click", () => {
      if (isValue) this.select(this.selected?.line === line ? null : { path: entry.path, line });
      else toggle?.();
    });
    if (!isValue) return line;
    if (this.selected?.path === entry.path) this.select({ path: entry.path, line });
    name.draggable = true;
    name.addEventListener("dragstart", (event) => event.dataTransfer?.setData(DRAGGED_PATH, entry.path));
    const deeds = make("span", { class: "deeds" });
    if (isImage(entry)) deeds.append(this.deed("image", { path: entry.path }));
    if (isNumber(entry)) deeds.append(this.deed("plot", { paths: [entry.path] }));
    deeds.append(this.deed("value", { path: entry.path }));
    line.append(deeds);
    return line;
  }

  private select(selected: Sidebar["selected"]): void {
    this.selected?.line.classList.remove("selected");
    selected?.line.classList.add("selected");
    this.selected = selected;
  }

  private deed(kind: string, settings: Record<string, string | string[]>): HTMLElement {
    const name = KINDS.find((one) => one.kind === kind)?.name ?? kind;
    return button(name, `open a panel: ${name}`, () => {
      document.body.classList.remove("with-paths");
      this.arrangement.add(kind, settings);
    });
  }
}
