// Owns how far the clocks of two robots are apart: each program counts from its own start.
import { expect } from "../connection/socket";
import type { Welcome } from "../protocol";
import type { Robot } from "./robot";
import { isSameRun } from "./run";
import { Signal, type Readable } from "./signal";

/** Robots of one world go on by turns: so far apart their clocks are one. In seconds. */
const SLACK = 0.1;

/** Of so many questions the one counts that was answered most quickly. */
const QUESTIONS = 3;

/** Between two values, in seconds. */
type Range = [number, number];

/** Seconds from the times of `other` to those of `own`; null: not known of the connections that there are now. Measured while somebody watches. */
export class Alignment implements Readable<number | null> {
  private readonly shift = new Signal<number | null>(null);
  /** Kept as long as it may be right, so that curves have no steps. */
  private last = 0;
  private turn = 0;
  private watchers = 0;
  /** Of which runs the clocks were measured: those go on while the connection does not. */
  private measured: [Welcome | null, Welcome | null] = [null, null];
  /** Whatever holds this and both robots: none of it stays when nobody watches, so that robots that went are released. */
  private stops: (() => void)[] = [];

  constructor(
    private readonly own: Pick<Robot, "ask" | "welcome">,
    private readonly other: Pick<Robot, "ask" | "welcome">,
  ) {}

  get value(): number | null {
    return this.shift.value;
  }

  watch(listener: (value: number | null) => void): () => void {
    if (this.watchers++ === 0) {
      // Either may have been started anew.
      const robots = [this.own, this.other];
      this.stops = robots.map((robot) => robot.welcome.watch(() => void this.measure()));
    }
    const stop = this.shift.watch(listener);
    let isOver = false;
    return () => {
      if (isOver) return;
      isOver = true;
      stop();
      if (--this.watchers === 0) this.rest();
    };
  }

  private rest(): void {
    for (const stop of this.stops) stop();
    this.stops = [];
    // What is still being measured is of now, and nobody knows what comes until somebody watches again.
    this.turn++;
    this.shift.set(null);
  }

  private async measure(): Promise<void> {
    const turn = ++this.turn;
    const [here, there] = [this.own.welcome.value, this.other.welcome.value];
    const isKnown = isSameRun(this.measured[0], here) === true && isSameRun(this.measured[1], there) === true;
    if (!isKnown) this.shift.set(null);
    let best: Range = [-Infinity, Infinity];
    try {
      for (let question = 0; question < QUESTIONS; question++) {
        const [own, other] = await Promise.all([lead(this.own), lead(this.other)]);
        const range: Range = [own[0] - other[1], own[1] - other[0]];
        if (range[1] - range[0] < best[1] - best[0]) best = range;
      }
    } catch {
      // A connection is gone: the next one asks again.
      return;
    }
    if (turn !== this.turn) return;
    this.measured = [here, there];
    const isStill = best[0] - SLACK <= this.last && this.last <= best[1] + SLACK;
    if (!isStill) this.last = (best[0] + best[1]) / 2;
    this.shift.set(this.last);
  }
}

/** How far the robot's clock is ahead of the browser's: what it says of parameters has the time of some moment between question and answer. */
async function lead(robot: Pick<Robot, "ask">): Promise<Range> {
  const asked = performance.now() / 1e3;
  const { time } = expect(await robot.ask({ read: { path: "parameters" } }), "value");
  return [time / 1e9 - performance.now() / 1e3, time / 1e9 - asked];
}
