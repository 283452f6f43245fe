// Owns the last seconds as the robot traced them: who ran when, read from Chrome's Trace Event Format.
import { expect } from "../connection/socket";
import type { Json } from "../protocol";
import type { Robot } from "./robot";

/** In microseconds of the robot's clock. */
export interface Span {
  name: string;
  begin: number;
  duration: number;
  cycle: number | null;
  isCycle: boolean;
}

export interface Lane {
  instance: string;
  /** By their begins. */
  spans: Span[];
}

export async function trace(robot: Robot, seconds: number): Promise<Lane[]> {
  return lanes(expect(await robot.ask({ trace: { seconds } }), "trace"));
}

/** What is no event is left out. */
function lanes(answer: Json): Lane[] {
  const events = record(answer)?.["traceEvents"];
  const byThread = new Map<number, Lane>();
  for (const value of Array.isArray(events) ? events : []) {
    const event = record(value);
    const { name, ph, ts, dur, tid, args, cat } = event ?? {};
    if (typeof name !== "string" || typeof tid !== "number") continue;
    if (ph === "M" && name === "thread_name") byThread.set(tid, { instance: String(record(args ?? null)?.["name"] ?? ""), spans: [] });
    if (ph !== "X" || typeof ts !== "number" || typeof dur !== "number") continue;
    const cycle = record(args ?? null)?.["cycle"];
    byThread.get(tid)?.spans.push({ name, begin: ts, duration: dur, cycle: typeof cycle === "number" ? cycle : null, isCycle: cat === "cycle" });
  }
  const found = [...byThread.values()];
  for (const lane of found) lane.spans.sort((one, other) => one.begin - other.begin);
  return found;
}

function record(value: Json): { [key: string]: Json } | null {
  return typeof value === "object" && value !== null && !Array.isArray(value) ? value : null;
}
