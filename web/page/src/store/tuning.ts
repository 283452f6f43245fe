// Owns what a panel of parameters works on: what the robot has, what was changed here and not sent, and what can be undone.
import { writeJson } from "../connection/exact";
import { expect } from "../connection/socket";
import type { Change, Entry, Json, Leaf, Reading, Unstored } from "../protocol";
import type { Robot } from "./robot";
import { Signal } from "./signal";

export interface Parameter {
  /** From the root of the parameters. */
  path: string;
  value: Json;
  leaf: Leaf;
  /** What the robot says of its type; absent where it says nothing. */
  entry: Entry | undefined;
  /** Changed while the robot runs, in no file. */
  isUnstored: boolean;
  /** What the files say, where it is not stored. */
  stored: Json;
  isCreationOnly: boolean;
}

export interface Tuned {
  version: number;
  parameters: readonly Parameter[];
  layers: readonly string[];
}

const UNDO = 100;

export class Tuning {
  readonly tuned = new Signal<Tuned | null>(null);
  /** Changed here and not sent, by path. */
  readonly pending = new Signal<ReadonlyMap<string, Json>>(new Map());
  /** Values that were replaced from here, newest last. */
  private readonly undone: Change[][] = [];

  constructor(private readonly robot: Robot) {}

  get canUndo(): boolean {
    return this.undone.length > 0;
  }

  /** Asks the robot for everything. */
  async load(): Promise<void> {
    const [reading, unstored, entries] = await Promise.all([
      this.robot.ask({ parameters: { path: "" } }).then((good) => expect(good, "parameters")),
      this.robot.ask({ unstored: {} }).then((good) => expect(good, "unstored")),
      this.robot.paths.everything("parameters").catch((): readonly Entry[] => []),
    ]);
    this.tuned.set(describe(reading, unstored, entries));
  }

  /** Notes a change; the value that the robot has takes the note away. */
  note(parameter: Parameter, value: Json): void {
    const pending = new Map(this.pending.value);
    if (writeJson(value) === writeJson(parameter.value)) pending.delete(parameter.path);
    else pending.set(parameter.path, value);
    this.pending.set(pending);
  }

  discard(): void {
    this.pending.set(new Map());
  }

  /** Sends what was noted: all of it is taken, or nothing. */
  async write(): Promise<void> {
    const changes = [...this.pending.value].map(([path, value]) => ({ path, value }));
    if (changes.length === 0) return;
    const before = changes.map(({ path }) => ({ path, value: this.valueOf(path) }));
    expect(await this.robot.ask({ write: { changes } }), "written");
    this.undone.push(before);
    if (this.undone.length > UNDO) this.undone.shift();
    this.discard();
  }

  /** Gives back what the last write from here replaced. */
  async undo(): Promise<void> {
    const changes = this.undone[this.undone.length - 1];
    if (changes === undefined) return;
    expect(await this.robot.ask({ write: { changes } }), "written");
    this.undone.pop();
    this.tuned.set(this.tuned.value);
  }

  /** Writes what is in no file into that of a layer; what it says for people. */
  async store(layer: string, paths: readonly string[] = []): Promise<string> {
    const stored = expect(await this.robot.ask({ store: { layer, paths: [...paths] } }), "stored");
    await this.load();
    return [`stored in ${stored.file}: ${stored.paths.join(", ")}`, ...stored.warnings].join("\n");
  }

  /** Takes what the files say; what was not stored is gone. */
  async reload(): Promise<void> {
    expect(await this.robot.ask({ reload: {} }), "written");
    await this.load();
  }

  private valueOf(path: string): Json {
    return this.tuned.value?.parameters.find((parameter) => parameter.path === path)?.value ?? null;
  }
}

function describe(reading: Reading, unstored: Unstored, entries: readonly Entry[]): Tuned {
  const byPath = new Map(entries.map((entry) => [entry.path, entry]));
  const changed = new Map(unstored.changes.map((change) => [change.path, change]));
  const parameters = reading.leaves.map((leaf): Parameter => {
    const change = [...changed.values()].find(({ path }) => path === leaf.path || path.startsWith(`${leaf.path}.`));
    return {
      path: leaf.path,
      leaf,
      value: part(reading.value, leaf.path),
      entry: byPath.get(`parameters.${leaf.path}`),
      isUnstored: change !== undefined,
      stored: change?.stored ?? null,
      isCreationOnly: unstored.creation_only.some((path) => leaf.path === path || leaf.path.startsWith(`${path}.`)),
    };
  });
  return { version: reading.version, parameters, layers: unstored.layers };
}

/** The part of a value at a path. */
export function part(value: Json, path: string): Json {
  let found: Json | undefined = value;
  for (const name of path === "" ? [] : path.split(".")) {
    if (typeof found !== "object" || found === null) return null;
    found = Array.isArray(found) ? found[Number(name)] : found[name];
  }
  return found ?? null;
}
