// The list of the robot's paths: levels are asked for when they are opened, everything when somebody searches.
import { KINDS } from "../panels/kinds";
import { DRAGGED_PATH } from "../panels/panel";
import type { Entry } from "../protocol";
import type { Arrangement } from "../store/layout";
import { isImage, isNumber, nameOf } from "../store/paths";
import type { Robot } from "../store/robot";
import { button, complain, make } from "./dom";

/** More matches are no help. */
const FOUND = 200;

export class Sidebar {
  readonly element: HTMLElement;
  private readonly list = make("ul", { class: "paths", role: "tree", "aria-label": "paths" });
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly search = make("input", { type: "search", placeholder: "search all paths  ( / )", "aria-label": "search all paths" });
  private readonly open = new Set<string>();
  private searches = 0;

  constructor(
    private readonly robot: Robot,
    private readonly arrangement: Arrangement,
  ) {
    this.element = make("nav", { class: "sidebar", "aria-label": "paths of the robot" }, make("div", { class: "bar" }, this.search), this.failure, this.list);
    this.search.addEventListener("input", () => void this.refresh());
    document.addEventListener("keydown", (event) => {
      if (event.key !== "/" || event.target instanceof HTMLInputElement || event.target instanceof HTMLTextAreaElement) return;
      event.preventDefault();
      this.search.focus();
    });
    robot.welcome.watch((welcome) => {
      if (welcome !== null) void this.refresh();
    });
  }

  private async refresh(): Promise<void> {
    const turn = ++this.searches;
    const words = this.search.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    try {
      const rows = words.length === 0 ? await this.level("") : await this.found(words);
      if (turn === this.searches) this.list.replaceChildren(...rows);
      complain(this.failure, null);
    } catch (error) {
      complain(this.failure, error);
    }
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

  private async row(entry: Entry): Promise<HTMLElement> {
    const list = make("ul", { role: "group", hidden: true });
    const fill = async (): Promise<void> => {
      list.replaceChildren(...(await this.level(entry.path)));
    };
    const caret = button("", `open ${entry.path}`, () => toggle(), "caret");
    const toggle = (): void => {
      list.hidden = !list.hidden;
      caret.classList.toggle("open", !list.hidden);
      caret.setAttribute("aria-expanded", String(!list.hidden));
      if (list.hidden) this.open.delete(entry.path);
      else {
        this.open.add(entry.path);
        fill().catch((error: unknown) => complain(this.failure, error));
      }
    };
    if (!entry.has_children) caret.classList.add("leaf");
    const row = make("li", { role: "treeitem" }, this.line(entry, nameOf(entry.path), entry.has_children ? caret : null, toggle), list);
    if (entry.has_children && this.open.has(entry.path)) {
      list.hidden = false;
      caret.classList.add("open");
      await fill();
    }
    return row;
  }

  private line(entry: Entry, text: string, caret: HTMLElement | null, toggle?: () => void): HTMLElement {
    const isValue = entry.kind !== "folder" && entry.kind !== "procedure" && entry.kind !== "message";
    const name = make("button", { type: "button", class: "name", title: [entry.path, entry.type, entry.documentation].filter((part) => part != null).join("\n") }, text);
    const type = make("span", { class: "muted type" }, [entry.type ?? "", entry.unit ?? ""].filter((part) => part !== "").join(" "));
    const line = make("div", { class: "line", "data-path": entry.path }, caret ?? make("span", { class: "caret leaf" }), name, type);
    name.addEventListener("click", () => {
      if (!isValue) toggle?.();
      else for (const one of this.list.querySelectorAll(".line.selected")) if (one !== line) one.classList.remove("selected");
      if (isValue) line.classList.toggle("selected");
    });
    if (!isValue) return line;
    name.draggable = true;
    name.addEventListener("dragstart", (event) => event.dataTransfer?.setData(DRAGGED_PATH, entry.path));
    const deeds = make("span", { class: "deeds" });
    if (isImage(entry)) deeds.append(this.deed("image", { path: entry.path }));
    if (isNumber(entry)) deeds.append(this.deed("plot", { paths: [entry.path] }));
    deeds.append(this.deed("value", { path: entry.path }));
    line.append(deeds);
    return line;
  }

  private deed(kind: string, settings: Record<string, string | string[]>): HTMLElement {
    const name = KINDS.find((one) => one.kind === kind)?.name ?? kind;
    return button(name, `open a panel: ${name}`, () => {
      document.body.classList.remove("with-paths");
      this.arrangement.add(kind, settings);
    });
  }
}
