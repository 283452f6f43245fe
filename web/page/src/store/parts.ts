// Owns parts of values by their paths, and where they come from.
import { writeJson } from "../connection/exact";
import type { Json, Leaf, Provenance } from "../protocol";

export function isSame(one: Json, other: Json): boolean {
  return writeJson(one) === writeJson(other);
}

/** Whether the first is the path of the second, or of something that it is in. */
export function isWithin(above: string, path: string): boolean {
  return above === "" || path === above || path.startsWith(`${above}.`);
}

/** The part of a value at a path. */
export function part(value: Json, path: string): Json {
  let found: Json | undefined = value;
  for (const name of namesOf(path)) {
    if (typeof found !== "object" || found === null) return null;
    found = Array.isArray(found) ? found[Number(name)] : found[name];
  }
  return found ?? null;
}

/** The value with another part at a path; as it is where it has no place for one. */
export function withPart(value: Json, path: string, content: Json): Json {
  const put = (whole: Json, [name, ...rest]: string[]): Json => {
    if (name === undefined) return content;
    if (typeof whole !== "object" || whole === null) return whole;
    if (Array.isArray(whole)) return whole.map((one, at) => (at === Number(name) ? put(one, rest) : one));
    return { ...whole, [name]: put(whole[name] ?? null, rest) };
  };
  return put(value, namesOf(path));
}

/**
 * Where a part was given last, the newest of all that is in it; where something else stands in place of what it was in, where
 * that was. Absent: there is no such part.
 */
export function provenanceAt(leaves: readonly Leaf[], path: string): Provenance | undefined {
  const below = leaves.filter((leaf) => isWithin(path, leaf.path));
  const all = (below.length > 0 ? below : leaves.filter((leaf) => isWithin(leaf.path, path))).map(({ provenance }) => provenance);
  const live = all.filter((one) => one.from === "live").sort((one, other) => other.version - one.version);
  return live[0] ?? all[0];
}

function namesOf(path: string): string[] {
  return path === "" ? [] : path.split(".");
}
