// Owns what was written from here and can be taken back: what each write replaced, and whether what it wrote still stands there.
import { writeJson } from "../connection/exact";
import type { Json, Provenance, Welcome } from "../protocol";
import { isSameRun } from "./run";
import type { Parameter } from "./tuning";

/** A value that was replaced from here. */
export interface Replaced {
  path: string;
  before: Json;
  /** As it was sent; as the robot has it (a float of 32 bits has fewer digits), once it has told. */
  written: Json;
  /** What brought it: its version, and on which connection, for another run counts versions anew. */
  run: Welcome | null;
  version: number;
}

interface Write {
  values: Replaced[];
}

/** What has changed since it was written from here: to take that back would overwrite what somebody else wrote. */
export interface Overtaken extends Replaced {
  now: Json;
  /** Where it comes from now. */
  provenance: Provenance;
}

const KEPT = 100;

export class Undone {
  /** Newest last. */
  private readonly writes: Write[] = [];

  get newest(): readonly Replaced[] | undefined {
    return this.writes.at(-1)?.values;
  }

  add(run: Welcome | null, version: number, values: readonly Pick<Replaced, "path" | "before" | "written">[]): void {
    this.writes.push({ values: values.map((one) => ({ ...one, run, version })) });
    if (this.writes.length > KEPT) this.writes.shift();
  }

  /** The newest write cannot be taken back, or is not to be. */
  forget(): void {
    this.writes.pop();
  }

  /** Of the newest write, these are left as they are. */
  keep(paths: readonly string[]): void {
    const newest = this.writes.at(-1);
    if (newest !== undefined) newest.values = newest.values.filter(({ path }) => !paths.includes(path));
  }

  /** The newest write was taken back: what the ones before it wrote stands there again. What else they wrote has the versions that it had. */
  givenBack(run: Welcome | null, version: number): void {
    for (const { path, before } of this.writes.pop()?.values ?? []) {
      const value = this.writes.flatMap(({ values }) => values).findLast((one) => one.path === path);
      if (value !== undefined && isSame(value.written, before)) Object.assign(value, { run, version });
    }
  }

  /** The robot tells its parameters: as it has them is how they were written, as far as nobody wrote since. */
  hear(run: Welcome | null, version: number, parameters: readonly Parameter[]): void {
    for (const value of this.writes.flatMap(({ values }) => values)) {
      const parameter = isSameRun(value.run, run) === true ? parameters.find(({ path }) => path === value.path) : undefined;
      const provenance = parameter?.leaf.provenance;
      const isOwn = version === value.version || (provenance?.from === "live" && provenance.version === value.version);
      if (parameter !== undefined && isOwn) value.written = parameter.value;
    }
  }

  /** What the newest write put there and is not there any more. */
  overtaken(parameters: readonly Parameter[]): Overtaken[] {
    return (this.newest ?? []).flatMap((value): Overtaken[] => {
      const now = parameters.find(({ path }) => path === value.path);
      return now === undefined || isSame(now.value, value.written) ? [] : [{ ...value, now: now.value, provenance: now.leaf.provenance }];
    });
  }
}

export function isSame(one: Json, other: Json): boolean {
  return writeJson(one) === writeJson(other);
}
