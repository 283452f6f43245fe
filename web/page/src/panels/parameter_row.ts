// One parameter: its value in the input that fits its type, its unit and range, and where it comes from.
import { readJson, writeJson } from "../connection/exact";
import type { Entry, Json, Provenance } from "../protocol";
import { nameOf } from "../store/paths";
import type { Parameter } from "../store/tuning";
import { make } from "../view/dom";
import { DRAGGED_PATH } from "./panel";

export interface RowListener {
  note(parameter: Parameter, value: Json): void;
  write(): void;
}

/** An input, how a value gets into it, and what it says; `undefined`: nothing that the robot would understand. */
interface Editor {
  element: HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement;
  set(value: Json): void;
  get(): Json | undefined;
}

export class ParameterRow {
  readonly element: HTMLElement;
  private readonly editor: Editor;
  private readonly origin = make("span", { class: "origin muted" });
  private readonly marks = make("span", { class: "marks" });
  private isEdited = false;

  constructor(
    private parameter: Parameter,
    private readonly listener: RowListener,
  ) {
    const { path, entry } = parameter;
    this.editor = editorFor(parameter);
    const input = this.editor.element;
    input.setAttribute("aria-label", path);
    input.dataset["path"] = path;
    const event = input instanceof HTMLInputElement && input.type !== "checkbox" ? "input" : "change";
    input.addEventListener(event, () => this.note());
    input.addEventListener("keydown", (pressed) => {
      const key = pressed as KeyboardEvent;
      if (key.key === "Enter" && !(input instanceof HTMLTextAreaElement)) listener.write();
      if (key.key === "Escape") {
        this.reset();
        listener.note(this.parameter, this.parameter.value);
      }
    });
    const about = [entry?.type, entry?.documentation].filter((text) => text != null).join("\n");
    const label = make("label", { class: "name", title: `${path}\n${about}`, draggable: "true" }, nameOf(path));
    label.addEventListener("dragstart", (drag) => drag.dataTransfer?.setData(DRAGGED_PATH, `parameters.${path}`));
    const unit = make("span", { class: "unit muted" }, [entry?.unit ?? "", rangeOf(entry)].filter((text) => text !== "").join(" "));
    this.element = make("div", { class: "parameter" }, label, input, unit, this.marks, this.origin);
    this.show(parameter);
  }

  /** What the robot has; what somebody edits here stays. */
  show(parameter: Parameter): void {
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
    if (!this.isEdited) this.editor.set(parameter.value);
  }

  mark(isEdited: boolean): void {
    this.isEdited = isEdited;
    this.element.classList.toggle("edited", isEdited);
  }

  /** Shows what the robot has again. */
  reset(): void {
    this.mark(false);
    this.element.classList.remove("wrong");
    if (document.activeElement !== this.editor.element || this.editor.get() !== this.parameter.value) this.editor.set(this.parameter.value);
  }

  private note(): void {
    const value = this.editor.get();
    this.element.classList.toggle("wrong", value === undefined);
    this.isEdited = true;
    if (value !== undefined) this.listener.note(this.parameter, value);
  }
}

function editorFor({ value, entry }: Parameter): Editor {
  if (typeof value === "boolean") return checkbox();
  if (entry !== undefined && (entry.choices ?? []).length > 0) return choice(entry.choices ?? []);
  if (typeof value === "number") return numeric(entry);
  if (typeof value === "string") return words();
  return json();
}

function checkbox(): Editor {
  const element = make("input", { type: "checkbox" });
  return { element, set: (value) => (element.checked = value === true), get: () => element.checked };
}

function choice(choices: readonly string[]): Editor {
  const element = make("select", {}, ...choices.map((name) => make("option", { value: name }, name)));
  return { element, set: (value) => (element.value = String(value)), get: () => element.value };
}

function numeric(entry: Entry | undefined): Editor {
  // Not `type=number`: it hides what it does not understand, and its wheel changes values while one scrolls.
  const element = make("input", { type: "text", inputmode: "decimal", spellcheck: "false" });
  const { minimum, maximum, is_half_open } = entry?.range ?? {};
  const get = (): number | undefined => {
    const value = Number(element.value.trim() === "" ? Number.NaN : element.value);
    const isInside = value >= (minimum ?? -Infinity) && value <= (maximum ?? Infinity) && !(is_half_open === true && value === maximum);
    return Number.isFinite(value) && isInside ? value : undefined;
  };
  element.addEventListener("keydown", (event) => {
    const direction = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const value = get();
    if (direction === undefined || value === undefined) return;
    event.preventDefault();
    element.value = String(step(value, direction, element.value));
    element.dispatchEvent(new Event("input"));
  });
  return { element, set: (value) => (element.value = String(value)), get };
}

/** One more or less of the last digit that stands there. */
function step(value: number, direction: number, text: string): number {
  const digits = /\.(\d+)$/.exec(text)?.[1]?.length ?? 0;
  return Number((value + direction * 10 ** -digits).toFixed(digits));
}

function words(): Editor {
  const element = make("input", { type: "text", spellcheck: "false" });
  return { element, set: (value) => (element.value = typeof value === "string" ? value : ""), get: () => element.value };
}

function json(): Editor {
  const element = make("textarea", { rows: 1, spellcheck: "false" });
  const get = (): Json | undefined => {
    try {
      return readJson(element.value);
    } catch {
      return undefined;
    }
  };
  return { element, set: (value) => (element.value = writeJson(value)), get };
}

function rangeOf(entry: Entry | undefined): string {
  const range = entry?.range;
  if (range == null) return "";
  return `${range.minimum ?? "−∞"} … ${range.is_half_open === true ? "< " : ""}${range.maximum ?? "∞"}`;
}

function originOf(provenance: Provenance): string {
  switch (provenance.from) {
    case "file":
      return `${provenance.file}:${provenance.line}`;
    case "environment":
      return `$${provenance.variable}`;
    case "setting":
      return `--set ${provenance.setting}`;
    case "live":
      return `live, version ${provenance.version}`;
    case "nowhere":
      return "default";
  }
}
