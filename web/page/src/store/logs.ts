// Owns what the robot said: of this run and of those before it, as far as it is kept.
import type { Log } from "../protocol";
import { Signal, type Readable } from "./signal";

/** Enough for minutes of a robot that talks, and little for a phone. */
const KEPT = 2000;
/** The run before would have said again by then what the page has: whoever has not is another one. */
const RECOGNITION_MILLISECONDS = 1000;

/** What the page says between messages of the robot. */
export interface Remark {
  remark: string;
}

export type Line = Log | Remark;

/** A connection of which nobody knows yet whether it is to the run before. */
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
  private stranger: Stranger | null = null;

  /** Oldest first. */
  get lines(): Readable<readonly Line[]> {
    return this.kept;
  }

  /** A connection begins, at this time of the robot's clock: the robot says again what it keeps, or is another run. */
  begin(time: number): void {
    // What was held back of a connection before is said again.
    this.stranger = { clock: time, held: [] };
  }

  add(log: Log): void {
    const { stranger } = this;
    if (stranger !== null) {
      const isSameRun = this.isSameRun(log, stranger);
      if (isSameRun === null) return this.hold(log, stranger);
      this.settle(stranger, isSameRun);
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

  /** Null: this message does not tell. */
  private isSameRun(log: Log, { clock, held }: Stranger): boolean | null {
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

  private settle({ held }: Stranger, isSameRun: boolean): void {
    this.stranger = null;
    if (!isSameRun) {
      this.newest = 0;
      this.push({ remark: "the robot began anew" });
    }
    for (const line of held) {
      if (isRemark(line)) this.push(line);
      else this.take(line);
    }
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
