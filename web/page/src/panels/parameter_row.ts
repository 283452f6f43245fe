// One parameter: its value in the input that fits its type, its unit and range, and where it comes from.
import { writeJson } from "../connection/exact";
import { nameOf } from "../store/paths";
import type { Json } from "../protocol";
import type { Draft, Parameter } from "../store/tuning";
import { make } from "../view/dom";
import { DRAGGED_PATH } from "./panel";
import { brief, keyOf, originOf, rangeOf, shapeOf, stepped, type Shape } from "./parameter_text";

export interface RowListener {
  note(parameter: Parameter, draft: Draft): void;
  discard(parameter: Parameter): void;
  write(): void;
}

export class ParameterRow {
  readonly element: HTMLElement;
  /** A parameter with another one needs another row. */
  readonly key: string;
  private readonly shape: Shape;
  /** What it was made for. */
  private readonly first: Json;
  private readonly input: HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement;
  private readonly origin = make("span", { class: "origin muted" });
  /** What others have put there while something was typed. */
  private readonly news = make("span", { class: "news", title: "changed by somebody else while you typed: to write overwrites it, Escape takes it" });
  private readonly marks = make("span");

  constructor(
    private parameter: Parameter,
    private readonly listener: RowListener,
  ) {
    const { path, entry } = parameter;
    this.key = keyOf(parameter);
    this.first = parameter.value;
    this.shape = shapeOf(parameter);
    this.input = inputFor(this.shape);
    this.input.setAttribute("aria-label", path);
    this.input.dataset["path"] = path;
    // With each key: what is not noted is lost when the robot says something.
    this.input.addEventListener("input", () => this.note());
    this.input.addEventListener("keydown", (pressed) => this.press(pressed as KeyboardEvent));
    const about = [entry?.type, entry?.documentation].filter((text) => text != null).join("\n");
    const label = make("label", { class: "name", title: `${path}\n${about}`, draggable: "true" }, nameOf(path));
    label.addEventListener("dragstart", (drag) => drag.dataTransfer?.setData(DRAGGED_PATH, `parameters.${path}`));
    const unit = make("span", { class: "unit muted" }, [entry?.unit ?? "", rangeOf(entry?.range)].filter((text) => text !== "").join(" "));
    this.element = make("div", { class: "parameter" }, label, this.input, unit, make("span", { class: "marks" }, this.news, this.marks), this.origin);
  }

  /** What was typed and not sent, or else what the robot has. */
  show(parameter: Parameter, draft: Draft | undefined, isChangedMeanwhile: boolean): void {
    this.parameter = parameter;
    const origin = originOf(parameter.leaf.provenance);
    this.origin.textContent = origin.slice(origin.lastIndexOf("/") + 1);
    this.origin.title = origin;
    const marks = [];
    if (parameter.isUnstored) marks.push("unsaved");
    if (parameter.isCreationOnly) marks.push("at start");
    this.marks.textContent = marks.join(", ");
    this.marks.title = parameter.isUnstored ? `the files say ${writeJson(parameter.stored)}` : "nodes read it when they are created";
    this.element.classList.toggle("unstored", parameter.isUnstored);
    this.draw(draft, isChangedMeanwhile);
  }

  draw(draft: Draft | undefined, isChangedMeanwhile: boolean): void {
    this.news.textContent = isChangedMeanwhile ? `now ${brief(this.parameter.value)} ` : "";
    const isWrong = draft !== undefined && "wrong" in draft;
    this.element.classList.toggle("edited", draft !== undefined);
    this.element.classList.toggle("wrong", isWrong);
    this.input.setAttribute("aria-invalid", String(isWrong));
    this.input.title = isWrong ? draft.wrong : "";
    const isTyped = document.activeElement === this.input && draft === undefined;
    // `1.50` is not made `1.5` under the hands of whoever types it.
    if (isTyped && this.means(this.text, this.parameter)) return;
    this.text = draft?.text ?? this.shape.write(this.parameter.value);
  }

  /**
   * Whether it can show a parameter. A text that gains or loses its ends of lines has another field, but not under the hands
   * of whoever types: what was typed would mean something else there, or lose its own ends of lines.
   */
  fits(parameter: Parameter, isEdited: boolean): boolean {
    if (this.key === keyOf(parameter)) return true;
    const isText = typeof this.first === "string" && typeof parameter.value === "string";
    return isEdited && isText && this.key === keyOf({ ...parameter, value: this.first });
  }

  focus(): void {
    this.input.focus({ preventScroll: true });
  }

  read(text: string): Draft {
    return this.shape.read(text);
  }

  private get text(): string {
    return this.input instanceof HTMLInputElement && this.input.type === "checkbox" ? String(this.input.checked) : this.input.value;
  }

  private set text(text: string) {
    if (text === this.text) return;
    if (this.input instanceof HTMLInputElement && this.input.type === "checkbox") this.input.checked = text === "true";
    else this.input.value = text;
  }

  private means(text: string, { value }: Parameter): boolean {
    const draft = this.shape.read(text);
    return "value" in draft && writeJson(draft.value) === writeJson(value);
  }

  private note(): void {
    this.listener.note(this.parameter, this.shape.read(this.text));
  }

  private press(event: KeyboardEvent): void {
    if (event.key === "Enter" && !(this.input instanceof HTMLTextAreaElement)) this.listener.write();
    if (event.key === "Escape") {
      this.text = this.shape.write(this.parameter.value);
      this.listener.discard(this.parameter);
    }
    const direction = ({ ArrowUp: 1, ArrowDown: -1 } as const)[event.key];
    if (this.shape.kind !== "number" || direction === undefined) return;
    const draft = this.shape.read(this.text);
    const next = "value" in draft ? stepped(this.text, direction, draft.value) : null;
    if (next === null) return;
    event.preventDefault();
    this.text = next;
    this.note();
  }
}

function inputFor(shape: Shape): HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement {
  const placeholder = shape.empty ?? null;
  switch (shape.kind) {
    case "flag":
      return make("input", { type: "checkbox" });
    case "choice":
      return make("select", {}, ...shape.choices.map((name) => make("option", { value: name }, name === "" ? "none" : name)));
    case "number":
      // Not `type=number`: it hides what it does not understand, and its wheel changes values while one scrolls.
      return make("input", { type: "text", inputmode: "decimal", spellcheck: "false", placeholder });
    case "words":
      return make("input", { type: "text", spellcheck: "false", placeholder });
    case "json":
      return make("textarea", { rows: 1, spellcheck: "false" });
  }
}
