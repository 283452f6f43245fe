// Owns the line where something failed, of a panel that asks its robot again and again beside what somebody does.
import { complain, make } from "./dom";

/** A question that goes well says nothing of a deed that failed before it: that stays until the next deed. */
export class Failures {
  readonly element = make("p", { class: "failure", hidden: true });
  private question: unknown = null;
  private deed: unknown = null;

  /** What became of a question that nobody put; null: it was answered. */
  asked(reason: unknown): void {
    this.question = reason;
    this.draw();
  }

  /** What became of what somebody did; null: it is done. */
  did(reason: unknown): void {
    this.deed = reason;
    this.draw();
  }

  private draw(): void {
    const reasons = [this.deed, this.question].filter((reason) => reason !== null).map((reason) => (reason instanceof Error ? reason.message : String(reason)));
    complain(this.element, reasons.length === 0 ? null : [...new Set(reasons)].join("\n"));
  }
}
