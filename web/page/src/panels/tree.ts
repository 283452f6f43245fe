// Owns a value drawn as a tree: parts that stay are changed in place, so that nothing flickers and open parts stay open.
import type { Decoded } from "../connection/binary";
import { make } from "../view/dom";
import { number } from "../view/format";
import { DRAGGED_PATH } from "./panel";

/** Longer lists would be slower to draw than anybody reads. */
const SHOWN = 200;

type Parts = [string, Decoded][];

function partsOf(value: Decoded): Parts | null {
  if (value instanceof Uint8Array || value === null || typeof value !== "object") return null;
  if (Array.isArray(value)) return value.slice(0, SHOWN).map((item, index) => [String(index), item as Decoded]);
  return Object.entries(value).slice(0, SHOWN) as Parts;
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
  private readonly list = make("ul");
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
    const parts = partsOf(this.value);
    const hasParts = parts !== null && parts.length > 0;
    this.caret.classList.toggle("leaf", !hasParts);
    this.caret.classList.toggle("open", this.isOpen);
    this.caret.setAttribute("aria-expanded", String(this.isOpen));
    const text = hasParts && this.isOpen ? "" : brief(this.value);
    if (this.text.textContent !== text) this.text.textContent = text;
    this.text.classList.toggle("none", this.value === null);
    this.text.classList.toggle("parts", hasParts);
    this.list.hidden = !hasParts || !this.isOpen;
    if (this.list.hidden || parts === null) return;
    this.drawParts(parts);
  }

  private drawParts(parts: Parts): void {
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
        this.list.append(branch.element);
      }
      branch.show(value);
    }
  }
}
