// Owns what the robot said: of this run and of those before it, as far as it is kept.
import type { Log, Welcome } from "../protocol";
import { isSameRun } from "./run";
import { Signal, type Readable } from "./signal";

/** Enough for minutes of a robot that talks, and little for a phone. */
const KEPT = 2000;
/** The run before would have said again by then what the page has: whoever has not is another one. */
const RECOGNITION_MILLISECONDS = 1000;
const ANEW = "the robot began anew";

/** What the page says between messages of the robot. */
export interface Remark {
  remark: string;
}

export type Line = Log | Remark;

/** A connection of which nobody knows yet whether it is to the run before: neither says. */
interface Stranger {
  /** The robot's clock when it began. */
  clock: number;
  /** What it said that the run before may have said while nobody heard it. */
  held: Line[];
}

export function isRemark(line: Line): line is Remark {
  return "remark" in line;
}

export class Logs {
  private readonly kept = new Signal<readonly Line[]>([]);
  /** Number of the newest message of this run. */
  private newest = 0;
  /** What the robot said first on the last connection of this run. */
  private run: Pick<Welcome, "run"> | null = null;
  private stranger: Stranger | null = null;

  /** Oldest first. */
  get lines(): Readable<readonly Line[]> {
    return this.kept;
  }

  /** A connection begins: the robot says again what it keeps, or is another run. */
  begin(welcome: Pick<Welcome, "run" | "time">): void {
    const isSame = isSameRun(this.run, welcome);
    this.run = welcome;
    // What was held back of a connection before is said again.
    this.stranger = isSame === null ? { clock: welcome.time, held: [] } : null;
    if (isSame === false) this.beginAnew();
  }

  add(log: Log): void {
    const { stranger } = this;
    if (stranger !== null) {
      const isSame = this.guess(log, stranger);
      if (isSame === null) return this.hold(log, stranger);
      this.settle(stranger, isSame);
    }
    this.take(log);
  }

  /** So many messages did not come through. */
  lost(messages: number): void {
    if (!(messages > 0)) return;
    const remark = { remark: `… ${messages} ${messages === 1 ? "message" : "messages"} left out` };
    if (this.stranger !== null && this.stranger.held.length > 0) this.stranger.held.push(remark);
    else this.push(remark);
  }

  /** Whether it is the run before. Null: this message does not tell. */
  private guess(log: Log, { clock, held }: Stranger): boolean | null {
    const messages = this.kept.value.filter((line): line is Log => !isRemark(line));
    const last = messages.at(-1);
    if (last === undefined) return true;
    // The same run says what it has in its order, and with it the newest that the page has. What begins behind that was
    // said while nobody was there: the clock tells, though those of recordings go back within one run.
    if (log.number > this.newest) return held.length === 0 && clock >= last.time;
    const same = messages.findLast(({ number }) => number === log.number);
    return same === undefined ? null : same.time === log.time && same.message === log.message;
  }

  private hold(log: Log, stranger: Stranger): void {
    stranger.held.push(log);
    if (stranger.held.length > 1) return;
    window.setTimeout(() => {
      if (this.stranger === stranger) this.settle(stranger, false);
    }, RECOGNITION_MILLISECONDS);
  }

  private settle({ held }: Stranger, isSame: boolean): void {
    this.stranger = null;
    if (!isSame) this.beginAnew();
    for (const line of held) {
      if (isRemark(line)) this.push(line);
      else this.take(line);
    }
  }

  private beginAnew(): void {
    this.newest = 0;
    const last = this.kept.value.at(-1);
    if (last !== undefined && !(isRemark(last) && last.remark === ANEW)) this.push({ remark: ANEW });
  }

  private take(log: Log): void {
    if (log.number <= this.newest) return;
    this.newest = log.number;
    this.push(log);
  }

  private push(line: Line): void {
    this.kept.set([...this.kept.value.slice(1 - KEPT), line]);
  }
}
