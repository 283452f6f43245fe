// Owns a value drawn as a tree: parts that stay are changed in place, so that nothing flickers and open parts stay open.
import type { Decoded } from "../connection/binary";
import { make } from "../view/dom";
import { number } from "../view/format";
import { DRAGGED_PATH } from "./panel";

/** Longer lists would be slower to draw than anybody reads. */
const SHOWN = 200;

type Parts = [string, Decoded][];

interface Shown {
  parts: Parts;
  /** So many more are not shown. */
  rest: number;
}

function partsOf(value: Decoded): Shown | null {
  if (value instanceof Uint8Array || value === null || typeof value !== "object") return null;
  // Long lists of numbers come often: only what is shown of them is looked at.
  const isList = Array.isArray(value);
  const parts = isList ? value.slice(0, SHOWN).map((item, index): [string, Decoded] => [String(index), item as Decoded]) : (Object.entries(value) as Parts);
  const count = isList ? value.length : parts.length;
  return { parts: parts.slice(0, SHOWN), rest: Math.max(count - SHOWN, 0) };
}

/** One line for a value. */
export function brief(value: Decoded): string {
  if (value === null) return "none";
  if (typeof value === "number") return number(value);
  if (typeof value === "bigint") return String(value);
  if (typeof value === "string") return value;
  if (typeof value === "boolean") return String(value);
  if (value instanceof Uint8Array) return `${value.length} bytes`;
  if (Array.isArray(value)) {
    const isShort = value.length <= 4 && value.every((item) => typeof item === "number" || typeof item === "bigint");
    return isShort ? `[${value.map((item) => brief(item as Decoded)).join(", ")}]` : `[${value.length}]`;
  }
  const names = Object.keys(value);
  return names.length === 0 ? "{}" : `{ ${names.slice(0, 4).join(", ")}${names.length > 4 ? ", …" : ""} }`;
}

/** A part of the tree, with those below it once it was opened. */
export class Branch {
  readonly element: HTMLLIElement;
  private readonly caret: HTMLButtonElement;
  private readonly text = make("span", { class: "reading" });
  /** Behind the parts that are shown. */
  private readonly rest = make("li", { class: "muted", hidden: true });
  private readonly list = make("ul", {}, this.rest);
  private readonly below = new Map<string, Branch>();
  private value: Decoded = null;
  private isOpen: boolean;

  constructor(name: string, path: string, isOpen = false) {
    this.isOpen = isOpen;
    this.path = path;
    this.caret = make("button", { type: "button", class: "caret", "aria-label": `open ${name}`, click: () => this.toggle() });
    const label = make("span", { class: "name", draggable: "true", title: path }, name);
    label.addEventListener("dragstart", (event) => event.dataTransfer?.setData(DRAGGED_PATH, path));
    this.element = make("li", {}, make("div", { class: "line" }, this.caret, label, this.text), this.list);
    this.draw();
  }

  private readonly path: string;

  show(value: Decoded): void {
    this.value = value;
    this.draw();
  }

  private toggle(): void {
    this.isOpen = !this.isOpen;
    this.draw();
  }

  private draw(): void {
    const shown = partsOf(this.value);
    const hasParts = shown !== null && shown.parts.length > 0;
    this.caret.classList.toggle("leaf", !hasParts);
    this.caret.classList.toggle("open", this.isOpen);
    this.caret.setAttribute("aria-expanded", String(this.isOpen));
    const text = hasParts && this.isOpen ? "" : brief(this.value);
    if (this.text.textContent !== text) this.text.textContent = text;
    this.text.classList.toggle("none", this.value === null);
    this.text.classList.toggle("parts", hasParts);
    this.list.hidden = !hasParts || !this.isOpen;
    if (this.list.hidden || shown === null) return;
    this.drawParts(shown);
  }

  private drawParts({ parts, rest }: Shown): void {
    const names = new Set(parts.map(([name]) => name));
    for (const [name, branch] of this.below) {
      if (names.has(name)) continue;
      branch.element.remove();
      this.below.delete(name);
    }
    for (const [name, value] of parts) {
      let branch = this.below.get(name);
      if (branch === undefined) {
        branch = new Branch(name, `${this.path}.${name}`);
        this.below.set(name, branch);
        this.list.insertBefore(branch.element, this.rest);
      }
      branch.show(value);
    }
    this.rest.hidden = rest === 0;
    const text = `and ${rest} more`;
    if (this.rest.textContent !== text) this.rest.textContent = text;
  }
}
