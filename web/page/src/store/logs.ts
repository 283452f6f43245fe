// Owns what the robot said: of this run and of those before it, as far as it is kept.
import type { Log } from "../protocol";
import { Signal, type Readable } from "./signal";

/** Enough for minutes of a robot that talks, and little for a phone. */
const KEPT = 2000;

/** What the page says between messages of the robot. */
export interface Remark {
  remark: string;
}

export type Line = Log | Remark;

export function isRemark(line: Line): line is Remark {
  return "remark" in line;
}

export class Logs {
  private readonly kept = new Signal<readonly Line[]>([]);
  /** Number of the newest message of this run. */
  private newest = 0;
  /** While nobody knows whether a connection is to the run before: the robot's clock when it began. */
  private clock: number | null = null;

  /** Oldest first. */
  get lines(): Readable<readonly Line[]> {
    return this.kept;
  }

  /** A connection begins, at this time of the robot's clock: the robot says again what it keeps, or is another run. */
  begin(time: number): void {
    this.clock = time;
  }

  add(log: Log): void {
    if (this.clock !== null) this.recognise(log, this.clock);
    this.clock = null;
    if (log.number <= this.newest) return;
    this.newest = log.number;
    this.push(log);
  }

  /** So many messages did not come through. */
  lost(messages: number): void {
    if (!(messages > 0)) return;
    this.push({ remark: `… ${messages} ${messages === 1 ? "message" : "messages"} left out` });
  }

  private recognise(log: Log, clock: number): void {
    const messages = this.kept.value.filter((line): line is Log => !isRemark(line));
    const last = messages.at(-1);
    if (last === undefined) return;
    const same = messages.findLast(({ number }) => number === log.number);
    // Clocks of recordings go back within one run, so what was said counts first.
    const isSameRun = same === undefined ? clock >= last.time : same.time === log.time && same.message === log.message;
    if (isSameRun) return;
    this.newest = 0;
    this.push({ remark: "the robot began anew" });
  }

  private push(line: Line): void {
    this.kept.set([...this.kept.value.slice(1 - KEPT), line]);
  }
}
