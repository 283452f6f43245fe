// What became of a recording, in words.
import type { RecordingCounts, Timings } from "../protocol";

export interface RecordedLine {
  readonly text: string;
  /** Whether there are frames that are not in the file and never were. */
  readonly isMissing: boolean;
}

const OUTPUTS = ".outputs";

/** Of an instance: its frames, and the values of its outputs that have a channel of their own. */
export function recordedOf(timings: Timings, instance: string): RecordedLine[] {
  const own = (timings.recording ?? []).filter((one) => owner(one.of) === instance);
  return own.filter(hasAny).map((one) => line(one.of === instance ? "recording" : "recording of outputs", one));
}

/** Of what belongs to no instance: log messages. */
export function recordedElsewhere(timings: Timings): RecordedLine[] {
  const instances = timings.instances.map((one) => one.name);
  const others = (timings.recording ?? []).filter((one) => !instances.includes(owner(one.of)));
  return others.filter(hasAny).map((one) => line(`recording of ${one.of}`, one));
}

function owner(of: string): string {
  return of.endsWith(OUTPUTS) ? of.slice(0, -OUTPUTS.length) : of;
}

function hasAny({ recorded, dropped, failed, lost, overwritten }: RecordingCounts): boolean {
  return recorded + dropped + failed + lost + overwritten > 0;
}

function line(what: string, { recorded, dropped, failed, lost, overwritten }: RecordingCounts): RecordedLine {
  const rare = Object.entries({ failed, lost, overwritten }).filter(([, count]) => count > 0);
  const counts = [`${recorded} recorded`, `${dropped} dropped`, ...rare.map(([name, count]) => `${count} ${name}`)];
  return { text: `${what}: ${counts.join(", ")}`, isMissing: dropped + failed + lost > 0 };
}
