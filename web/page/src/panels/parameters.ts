// A panel to read and change the robot's parameters: several at once, with where they come from, and back into a file.
import { Tuning, type Draft, type Parameter, type Tuned } from "../store/tuning";
import type { Overtaken } from "../store/undone";
import { button, complain, make, select } from "../view/dom";
import { plural } from "../view/format";
import { textSetting, type Context, type Panel, type PanelKind } from "./panel";
import { ParameterRow } from "./parameter_row";
import { overtakenText } from "./parameter_text";

class Parameters implements Panel {
  readonly content: HTMLElement;
  readonly tools: HTMLElement[];
  private readonly tuning: Tuning;
  private readonly list = make("div", { class: "parameters" });
  /** Of the last deed. What was in the way of reading has a line of its own: it goes by itself. */
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly unread = make("p", { class: "failure", hidden: true });
  private readonly said = make("p", { class: "said", hidden: true });
  private readonly search: HTMLInputElement;
  /** Bars are made once: what is pressed in one of them while the robot says something is not lost. */
  private readonly unsent = make("span");
  private readonly wrong = make("span", { class: "wrong", hidden: true });
  private readonly writing = make(
    "div",
    { class: "bar writing", hidden: true },
    this.unsent,
    this.wrong,
    button("Write", "all of them at once, or none", () => this.attempt(() => this.tuning.write()), "deed"),
    button("Discard", "forget them", () => this.tuning.discard()),
  );
  private readonly others = make("span", { class: "wrong" });
  private readonly overtaken = make(
    "div",
    { class: "bar overtaken", hidden: true },
    this.others,
    button("Overwrite", "take the write back in spite of that: what was there before it is written", () => this.attempt(() => this.tuning.undo("overwrite")), "deed"),
    button("Keep", "leave what is there now; what else that write changed is taken back", () => this.attempt(() => this.tuning.undo("keep"))),
  );
  private readonly unstored = make("span");
  private readonly layers = select([], "", "layer", (layer) => {
    this.layer = layer;
    this.save();
  });
  private readonly storing = make(
    "div",
    { class: "bar storing", hidden: true },
    this.unstored,
    this.layers,
    button("Store", "write them into the file of this layer", () => this.attempt(() => this.tuning.store(this.layer)), "deed"),
  );
  private readonly undo: HTMLButtonElement;
  private readonly rows = new Map<string, ParameterRow>();
  private readonly stops: (() => void)[];
  private layer: string;

  constructor(private readonly context: Context) {
    this.layer = textSetting(context.settings, "layer");
    this.tuning = new Tuning(context.robot);
    this.search = make("input", { type: "search", value: textSetting(context.settings, "words"), placeholder: "search a parameter", "aria-label": "search a parameter" });
    this.search.addEventListener("input", () => {
      this.save();
      this.filter();
    });
    this.undo = button("Undo", "take the last write from here back", () => this.attempt(() => this.tuning.undo()));
    this.tools = [
      this.undo,
      button("Reload", "take what the files say: changes that were not stored are gone", () => this.attempt(() => this.tuning.reload())),
    ];
    // In sight wherever one has scrolled to: one box for all, which would cover each other.
    const answers = make("div", { class: "answers" }, this.writing, this.overtaken, this.storing, this.failure, this.unread, this.said);
    this.content = make("div", { class: "scroll" }, make("div", { class: "bar" }, this.search), answers, this.list);
    this.stops = [
      context.robot.parameters.watch(() => void this.load()),
      context.robot.canWrite.watch((can) => this.content.classList.toggle("read-only", !can)),
      this.tuning.tuned.watch((tuned) => this.draw(tuned)),
      this.tuning.pending.watch((pending) => this.drawPending(pending)),
      this.tuning.overtaken.watch((overtaken) => this.drawOvertaken(overtaken)),
    ];
  }

  close(): void {
    for (const stop of this.stops) stop();
  }

  accept(path: string): void {
    this.search.value = path.replace(/^parameters\./, "");
    this.filter();
  }

  private async load(): Promise<void> {
    if (this.context.robot.state.value !== "open" && this.context.robot.welcome.value === null) return;
    try {
      const said = await this.tuning.load();
      if (said !== undefined) complain(this.said, said);
      complain(this.unread, null);
    } catch (error) {
      complain(this.unread, error);
    }
  }

  private attempt(deed: () => Promise<string | void>): void {
    complain(this.failure, null);
    deed().then(
      (said) => complain(this.said, said ?? null),
      (error: unknown) => complain(this.failure, error),
    );
  }

  private save(): void {
    this.context.save({ words: this.search.value, layer: this.layer });
  }

  private draw(tuned: Tuned | null): void {
    this.undo.disabled = !this.tuning.canUndo;
    if (tuned === null) return;
    if (!this.isBuilt(tuned)) this.build(tuned);
    const pending = this.tuning.pending.value;
    for (const parameter of tuned.parameters) this.rows.get(parameter.path)?.show(parameter, pending.get(parameter.path), this.tuning.isChangedMeanwhile(parameter.path));
    this.filter();
    this.drawStoring(tuned);
  }

  private isBuilt({ parameters }: Tuned): boolean {
    return parameters.length === this.rows.size && parameters.every((parameter) => this.fits(this.rows.get(parameter.path), parameter));
  }

  private fits(row: ParameterRow | undefined, parameter: Parameter): row is ParameterRow {
    return row?.fits(parameter, this.tuning.pending.value.has(parameter.path)) === true;
  }

  /** Rows that still fit stay as they are, with groups that are open and with the focus. */
  private build(tuned: Tuned): void {
    const before = new Map(this.rows);
    const details = [...this.list.querySelectorAll<HTMLDetailsElement>("details[open]")];
    const open = new Set(details.map((one) => one.dataset["below"]));
    const focused = document.activeElement instanceof HTMLElement && this.list.contains(document.activeElement) ? document.activeElement : null;
    this.rows.clear();
    const row = (parameter: Parameter): HTMLElement => {
      const kept = before.get(parameter.path);
      const row = this.fits(kept, parameter) ? kept : this.row(parameter);
      this.rows.set(parameter.path, row);
      return row.element;
    };
    this.list.replaceChildren(...group("", tuned.parameters, row));
    for (const one of this.list.querySelectorAll<HTMLDetailsElement>("details")) one.open = open.has(one.dataset["below"]);
    (focused === null ? undefined : this.rows.get(focused.dataset["path"] ?? ""))?.focus();
    for (const parameter of tuned.parameters) {
      const [row, draft] = [this.rows.get(parameter.path), this.tuning.pending.value.get(parameter.path)];
      // What was typed may mean something else now.
      if (row !== undefined && draft !== undefined && row !== before.get(parameter.path)) this.tuning.note(parameter, row.read(draft.text));
    }
  }

  private row(parameter: Parameter): ParameterRow {
    return new ParameterRow(parameter, {
      note: (shown, draft) => this.tuning.note(shown, draft),
      discard: (shown) => this.tuning.discard(shown.path),
      write: () => this.attempt(() => this.tuning.write()),
    });
  }

  private drawPending(pending: ReadonlyMap<string, Draft>): void {
    // What is not edited any more may have another field.
    const tuned = this.tuning.tuned.value;
    if (tuned !== null && this.rows.size > 0 && !this.isBuilt(tuned)) this.draw(tuned);
    for (const [path, row] of this.rows) row.draw(pending.get(path), this.tuning.isChangedMeanwhile(path));
    const wrong = [...pending].flatMap(([path, draft]) => ("wrong" in draft ? [`${path}: ${draft.wrong}`] : []));
    this.undo.disabled = !this.tuning.canUndo;
    this.writing.hidden = pending.size === 0;
    say(this.unsent, `${plural(pending.size, "change")} not sent`);
    complain(this.wrong, wrong.length === 0 ? null : wrong.join(", "));
  }

  private drawOvertaken(overtaken: readonly Overtaken[]): void {
    this.overtaken.hidden = overtaken.length === 0;
    say(this.others, overtakenText(overtaken));
  }

  private drawStoring(tuned: Tuned): void {
    const unstored = tuned.parameters.filter((parameter) => parameter.isUnstored);
    this.storing.hidden = unstored.length === 0;
    say(this.unstored, `${plural(unstored.length, "parameter")} in no file`);
    if (!tuned.layers.includes(this.layer)) this.layer = tuned.layers[tuned.layers.length - 1] ?? "";
    const offered = [...this.layers.options].map(({ value }) => value);
    if (offered.join("\n") !== tuned.layers.join("\n")) this.layers.replaceChildren(...tuned.layers.map((layer) => make("option", { value: layer }, layer)));
    if (this.layers.value !== this.layer) this.layers.value = this.layer;
  }

  private filter(): void {
    const words = this.search.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    for (const [path, row] of this.rows) row.element.hidden = !words.every((word) => path.toLowerCase().includes(word));
    const groups = [...this.list.querySelectorAll<HTMLDetailsElement>("details")].reverse();
    for (const one of groups) {
      one.hidden = one.querySelector(".parameter:not([hidden])") === null;
      if (words.length > 0) one.open = !one.hidden;
    }
  }
}

/** Also what says the same loses a selection when it is said again. */
function say(element: HTMLElement, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Parameters below a path: those that stand there, and groups of those further down. */
function group(above: string, parameters: readonly Parameter[], row: (parameter: Parameter) => HTMLElement): HTMLElement[] {
  const groups = new Map<string, Parameter[]>();
  for (const parameter of parameters) {
    const rest = parameter.path.slice(above.length);
    const end = rest.indexOf(".");
    const name = end < 0 ? rest : rest.slice(0, end + 1);
    groups.set(name, [...(groups.get(name) ?? []), parameter]);
  }
  return [...groups].flatMap(([name, below]) => {
    if (!name.endsWith(".")) return below.map(row);
    const content = make("div", { class: "group" }, ...group(above + name, below, row));
    const count = make("span", { class: "muted" }, String(below.length));
    return [make("details", { "data-below": above + name }, make("summary", {}, name.slice(0, -1), " ", count), content)];
  });
}

export const parameters: PanelKind = { kind: "parameters", name: "Parameters", open: (context) => new Parameters(context) };
