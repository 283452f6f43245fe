// Owns what was written from here and can be taken back: what each write replaced, and whether what it wrote still stands there.
import type { Json, Provenance, Reading, Welcome } from "../protocol";
import { isSame, isWithin, part, provenanceAt } from "./parts";
import { isSameRun } from "./run";

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

export interface Write {
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

  get newest(): Readonly<Write> | undefined {
    return this.writes.at(-1);
  }

  add(run: Welcome | null, version: number, values: readonly Pick<Replaced, "path" | "before" | "written">[]): void {
    this.writes.push({ values: values.map((one) => ({ ...one, run, version })) });
    if (this.writes.length > KEPT) this.writes.shift();
  }

  /** The newest write is not to be taken back. */
  forget(): void {
    this.writes.pop();
  }

  /** Of the newest write, these are left as they are. */
  keep(paths: readonly string[]): void {
    const newest = this.writes.at(-1);
    if (newest !== undefined) newest.values = newest.values.filter(({ path }) => !paths.includes(path));
  }

  /** The robot does not take these back, and never will; where it names nothing of the newest write, all of it. */
  refuse(refused: readonly string[]): void {
    const paths = (this.newest?.values ?? []).map(({ path }) => path);
    const own = (other: string): string[] => paths.filter((path) => isWithin(path, other) || (other !== "" && isWithin(other, path)));
    this.keep(refused.every((other) => own(other).length > 0) ? refused.flatMap(own) : paths);
    if (this.newest?.values.length === 0) this.forget();
  }

  /** The newest write was taken back: what the ones before it wrote stands there again. What else they wrote has the versions that it had. */
  givenBack(run: Welcome | null, version: number): void {
    for (const { path, before } of this.writes.pop()?.values ?? []) {
      const value = this.writes.flatMap(({ values }) => values).findLast((one) => one.path === path);
      if (value !== undefined && isSame(value.written, before)) Object.assign(value, { run, version });
    }
  }

  /** The robot tells its parameters: as it has them is how they were written, as far as nobody wrote since. */
  hear(run: Welcome | null, reading: Reading): void {
    for (const value of this.writes.flatMap(({ values }) => values)) {
      if (isSameRun(value.run, run) === true && isOf(reading, value.path, value.version)) value.written = part(reading.value, value.path);
    }
  }

  /** Forgets what is as it was before already, of the newest write, and where nothing of it is left, of the one before. */
  settle(reading: Reading): void {
    for (let newest = this.newest; newest !== undefined; newest = this.newest) {
      this.keep(newest.values.filter((one) => isBack(reading, one)).map(({ path }) => path));
      if (newest.values.length > 0) return;
      this.forget();
    }
  }

  /** What the newest write put there and is not there any more. */
  overtaken(reading: Reading): Overtaken[] {
    return (this.newest?.values ?? []).flatMap((value): Overtaken[] => {
      const now = part(reading.value, value.path);
      const provenance = provenanceAt(reading.leaves, value.path);
      return provenance === undefined || isSame(now, value.written) || isBack(reading, value) ? [] : [{ ...value, now, provenance }];
    });
  }
}

function isBack({ value, leaves }: Reading, { path, before }: Replaced): boolean {
  return leaves.some((leaf) => isWithin(path, leaf.path)) && isSame(part(value, path), before);
}

/** Whether what a robot tells of a path is of a version, and of none behind it. */
export function isOf({ version, leaves }: Reading, path: string, wanted: number): boolean {
  const provenance = provenanceAt(leaves, path);
  return provenance !== undefined && (version === wanted || (provenance.from === "live" && provenance.version === wanted));
}
