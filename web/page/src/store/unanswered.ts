// Owns what becomes of a write whose answer was lost with the connection: what the robot tells next shows whether it was taken.
import type { Json, Reading, Welcome } from "../protocol";
import { isSame, part, provenanceAt } from "./parts";
import type { Replaced } from "./undone";

export interface Unanswered {
  run: Welcome | null;
  /** What the robot had told last by then. */
  version: number;
  values: readonly Pick<Replaced, "path" | "before" | "written">[];
}

/** The version that it has become; null: it was not taken, or somebody has written over it. */
export function versionOf({ version, values }: Unanswered, reading: Reading): number | null {
  const versions = new Set<number>();
  for (const { path, written } of values) {
    const provenance = provenanceAt(reading.leaves, path);
    if (provenance === undefined || !isHeld(part(reading.value, path), written)) return null;
    // Of what is again as the files say, the robot does not tell which version brought it.
    if (provenance.from === "live") versions.add(provenance.version);
  }
  const [found, ...others] = versions;
  return found !== undefined && found > version && others.length === 0 ? found : null;
}

/** Whether a robot has what was written: a float of 32 bits has fewer digits. */
function isHeld(now: Json, written: Json): boolean {
  if (typeof now === "number" && typeof written === "number") return now === written || Math.fround(now) === Math.fround(written);
  if (typeof now !== "object" || typeof written !== "object" || now === null || written === null) return isSame(now, written);
  const [ours, theirs] = [Object.entries(written), Object.entries(now)];
  return Array.isArray(now) === Array.isArray(written) && ours.length === theirs.length && ours.every(([name, one]) => isHeld(part(now, name), one));
}
