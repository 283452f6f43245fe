// Owns what one panel has put in place of an output: at most one value, which is released when the panel goes.
import { expect, Refused } from "../connection/socket";
import type { Json } from "../protocol";
import type { Robot } from "./robot";
import { Signal, type Readable } from "./signal";
import { Turns } from "./turns";

export class Injection {
  private readonly injected = new Signal<string | null>(null);
  /** A release waits for the answer to what it releases: it may come long after somebody asked for it. */
  private readonly turns = new Turns();
  /** Whether the robot has shown since then that it is injected. */
  private isSeen = false;
  private isEnding = false;

  constructor(private readonly robot: Pick<Robot, "ask">) {}

  /** The path of the output; null: there is none. */
  get path(): Readable<string | null> {
    return this.injected;
  }

  inject(path: string, value: Json): Promise<void> {
    return this.turns.take(async () => {
      if (this.injected.value !== path) await this.giveBack();
      expect(await this.robot.ask({ inject: { path, value } }), "done");
      this.isSeen = false;
      this.injected.set(path);
    });
  }

  /** What the robot shows of this output. Whether somebody else has released what was injected here: it was there, and is no more. */
  mark(path: string, isInjected: boolean): boolean {
    if (path !== this.injected.value || this.isEnding) return false;
    const isOver = this.isSeen && !isInjected;
    this.isSeen = isInjected;
    if (isOver) this.forget();
    return isOver;
  }

  /** What was injected here; where nothing was, what anybody has put in place of this output. */
  release(output?: string): Promise<void> {
    return this.turns.take(async () => {
      if (this.injected.value !== null || output === undefined) return this.giveBack();
      expect(await this.robot.ask({ release: { path: output } }), "done");
    });
  }

  /** The robot released it by itself. */
  forget(): void {
    this.injected.set(null);
  }

  /** Nobody can release it later. */
  close(): void {
    this.release().catch(() => undefined);
  }

  private async giveBack(): Promise<void> {
    const path = this.injected.value;
    if (path === null) return;
    this.isEnding = true;
    try {
      expect(await this.robot.ask({ release: { path } }), "done");
    } catch (error) {
      // Somebody else has released it: there is nothing to give back.
      if (!(error instanceof Refused)) throw error;
    } finally {
      this.isEnding = false;
    }
    this.injected.set(null);
  }
}
