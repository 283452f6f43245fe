// Owns what a panel of parameters works on: what the robot has, what was changed here and not sent, and what can be undone.
import { expect, Refused, Unheard } from "../connection/socket";
import type { Change, Entry, Json, Leaf, Reading, Unstored, Welcome } from "../protocol";
import type { Robot } from "./robot";
import { isSame, isWithin, part, provenanceAt, withPart } from "./parts";
import { isSameRun } from "./run";
import { Signal } from "./signal";
import { Turns } from "./turns";
import { versionOf, type Unanswered } from "./unanswered";
import { isOf, Undone, type Overtaken } from "./undone";

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
  /** Of everything. */
  reading: Reading;
  parameters: readonly Parameter[];
  layers: readonly string[];
}

/** What somebody typed: the value that it is, or the reason why it is none. */
export type Draft = { text: string; value: Json } | { text: string; wrong: string };

interface Begun {
  value: Json;
  /** What was done from here since then, on which connection: what the robot tells of this version is what it made of it. */
  own?: { run: Welcome | null; version: number; isReload: boolean };
}

export class Tuning {
  readonly tuned = new Signal<Tuned | null>(null);
  /** Changed here and not sent, by path. */
  readonly pending = new Signal<ReadonlyMap<string, Draft>>(new Map());
  /** What the robot had when somebody began to type, by path; or has from here since then. */
  private readonly begun = new Map<string, Begun>();
  /** Why the last write from here was not taken back: what others have put in its place. */
  readonly overtaken = new Signal<readonly Overtaken[]>([]);
  private readonly undone = new Undone();
  /** What a write replaces is known once the one before was answered. */
  private readonly turns = new Turns();
  /** The last write from here, and on which connection: another run counts versions anew. */
  private written: { run: Welcome | null; version: number } = { run: null, version: 0 };
  /** The last write, where its answer was lost and the robot has not shown that it took it. */
  private unanswered: Unanswered | null = null;
  /** What the robot said last of the types, and on which connection. */
  private types: { run: Welcome | null; entries: readonly Entry[] } = { run: null, entries: [] };
  private loads = 0;
  private shownLoad = 0;

  constructor(private readonly robot: Pick<Robot, "ask" | "paths" | "welcome">) {}

  get canUndo(): boolean {
    return this.undone.newest !== undefined;
  }

  /** Asks the robot for everything; what it says for people. */
  async load(): Promise<string | void> {
    const load = ++this.loads;
    const [reading, unstored, entries] = await Promise.all([
      this.robot.ask({ parameters: { path: "" } }).then((good) => expect(good, "parameters")),
      this.robot.ask({ unstored: {} }).then((good) => expect(good, "unstored")),
      this.entries(),
    ]);
    // Of before the last write, or behind the answer to a later question: what is newer is there, or asked for.
    const isOld = this.isOfThisRun(this.written.run) && reading.version < this.written.version;
    if (isOld || load < this.shownLoad) return;
    this.shownLoad = load;
    const tuned = describe(reading, unstored, entries);
    const gone = this.forgetWithout(tuned);
    const taken = this.takeUnanswered(reading);
    this.undone.hear(this.robot.welcome.value, reading);
    this.hearOwn(reading);
    this.tuned.set(tuned);
    // What the robot has waits no more to be sent to it.
    this.settle([...tuned.parameters, ...taken]);
    // What is told of it is of now.
    if (this.overtaken.value.length > 0) this.overtaken.set(this.undone.overtaken(reading));
    const said = [gone, taken.length > 0 ? "the robot has taken the write whose answer was lost" : undefined].filter((text) => text !== undefined);
    return said.length > 0 ? said.join("\n") : undefined;
  }

  /** Where the robot has what was written before the connection was lost, that is a write like others; what was written. */
  private takeUnanswered(reading: Reading): Change[] {
    const { unanswered } = this;
    if (unanswered === null) return [];
    const isOfThisRun = this.isOfThisRun(unanswered.run);
    const version = isOfThisRun ? versionOf(unanswered, reading) : null;
    if (version !== null || !isOfThisRun) this.unanswered = null;
    if (version === null) return [];
    this.undone.add(unanswered.run, version, unanswered.values);
    for (const { path } of unanswered.values) if (this.begun.has(path)) this.begun.set(path, { value: part(reading.value, path) });
    return unanswered.values.map(({ path, written }) => ({ path, value: written }));
  }

  /** Where the robot does not answer for once, types are as before: without them what was typed would mean something else. */
  private async entries(): Promise<readonly Entry[]> {
    const run = this.robot.welcome.value;
    try {
      const entries = await this.robot.paths.everything("parameters");
      this.types = { run, entries };
      return entries;
    } catch {
      return this.isOfThisRun(this.types.run) ? this.types.entries : [];
    }
  }

  /** Where the robot does not tell, another connection may be to another run. */
  private isOfThisRun(welcome: Welcome | null): boolean {
    return isSameRun(welcome, this.robot.welcome.value) === true;
  }

  /** Notes what was typed; the value that the robot has takes the note away. */
  note(parameter: Parameter, draft: Draft): void {
    const pending = new Map(this.pending.value);
    if ("value" in draft && isSame(draft.value, parameter.value)) pending.delete(parameter.path);
    else {
      if (!pending.has(parameter.path)) this.begun.set(parameter.path, { value: parameter.value });
      pending.set(parameter.path, draft);
    }
    this.setPending(pending);
  }

  /** Whether somebody else has changed a parameter while something was typed for it here: to write that overwrites it. */
  isChangedMeanwhile(path: string): boolean {
    const begun = this.begun.get(path);
    const parameter = this.tuned.value?.parameters.find((one) => one.path === path);
    return begun !== undefined && parameter !== undefined && !isSame(begun.value, parameter.value);
  }

  /**
   * What was done from here is no news, whatever is typed. Where it comes from does not tell: of what is again as the files
   * say, the robot says no more that it was changed.
   */
  private hearOwn(reading: Reading): void {
    for (const [path, { own }] of this.begun) {
      if (own === undefined || !this.isOfThisRun(own.run) || reading.version < own.version) continue;
      const provenance = provenanceAt(reading.leaves, path);
      const isNewer = provenance?.from === "live" && provenance.version > own.version;
      if (own.isReload ? !isNewer : isOf(reading, path, own.version)) this.begun.set(path, { value: part(reading.value, path) });
    }
  }

  private setPending(pending: ReadonlyMap<string, Draft>): void {
    for (const path of [...this.begun.keys()]) if (!pending.has(path)) this.begun.delete(path);
    this.pending.set(pending);
  }

  /** Forgets what was typed for a path; absent: everything. */
  discard(path?: string): void {
    this.setPending(new Map(path === undefined ? [] : [...this.pending.value].filter(([other]) => other !== path)));
  }

  /** Sends what was noted by now: all of it is taken, or nothing. */
  async write(): Promise<void> {
    const noted = [...this.pending.value];
    const wrong = noted.flatMap(([path, draft]) => ("wrong" in draft ? [`${path}: ${draft.wrong}`] : []));
    if (wrong.length > 0) throw new Error(`nothing was sent\n${wrong.join("\n")}`);
    const wanted = noted.flatMap(([path, draft]) => ("value" in draft ? [{ path, value: draft.value }] : []));
    await this.turns.take(async () => {
      // Somebody who presses twice wants it once.
      const changes = wanted.filter(({ path, value }) => !isSame(value, this.valueOf(path)));
      if (changes.length > 0) {
        const replaced = changes.map(({ path, value }) => ({ path, before: this.valueOf(path), written: value }));
        const [run, version] = [this.robot.welcome.value, this.tuned.value?.reading.version ?? 0];
        await this.send(changes).catch((error: unknown) => {
          if (error instanceof Unheard) this.unanswered = { run, version, values: replaced };
          throw error;
        });
        this.undone.add(this.written.run, this.written.version, replaced);
        this.settleUndo();
      }
      this.settle(wanted);
    });
  }

  /**
   * Gives back what the last write from here replaced. Where somebody else has written since, nothing is sent, and `overtaken`
   * tells: it may be overwritten as it was told, or kept, so that the rest alone is given back. What it says for people.
   */
  undo(choice?: "overwrite" | "keep"): Promise<string | void> {
    const [told, asked] = [this.overtaken.value, this.undone.newest];
    return this.turns.take(async () => {
      if (!this.canUndo) return;
      // What others wrote may not have been heard of yet.
      const said = await this.load();
      const reading = this.tuned.value?.reading ?? { value: null, version: 0, leaves: [] };
      this.undone.settle(reading);
      // What was chosen was so for a write of which nothing is left.
      const isOver = choice !== undefined && this.undone.newest !== asked;
      if (isOver || !this.canUndo) {
        this.settleUndo();
        return said ?? "nothing was sent: everything is as it was before already";
      }
      const overtaken = this.undone.overtaken(reading);
      if (choice === "keep") this.undone.keep(overtaken.map(({ path }) => path));
      const isTold = overtaken.every(({ path, now }) => told.some((one) => one.path === path && isSame(one.now, now)));
      if (overtaken.length > 0 && choice !== "keep" && !(choice === "overwrite" && isTold)) {
        this.overtaken.set(overtaken);
        return said;
      }
      await this.giveBack();
      this.settleUndo();
      return said;
    });
  }

  private async giveBack(): Promise<void> {
    const changes = (this.undone.newest?.values ?? []).map(({ path, before }) => ({ path, value: before }));
    if (changes.length === 0) return this.undone.forget();
    try {
      await this.send(changes);
    } catch (error) {
      // Values that this robot does not take never will be: the rest of the write, and the write before, may still be undone.
      const refusals = error instanceof Refused ? (error.failure.refusals ?? []) : [];
      if (!(error instanceof Refused) || refusals.length === 0) throw error;
      const newest = this.undone.newest;
      this.undone.refuse(refusals.map(({ path }) => path));
      this.settleUndo();
      const isLeft = this.undone.newest === newest;
      throw new Error(`${isLeft ? "this cannot be taken back, and the next Undo gives back the rest of that write" : "the last write cannot be taken back"}: ${error.message}`);
    }
    this.undone.givenBack(this.written.run, this.written.version);
  }

  /** Another write is the last one now. */
  private settleUndo(): void {
    this.overtaken.set([]);
    this.tuned.set(this.tuned.value);
  }

  /** Writes what is in no file into that of a layer; what it says for people. */
  async store(layer: string, paths: readonly string[] = []): Promise<string> {
    const stored = expect(await this.robot.ask({ store: { layer, paths: [...paths] } }), "stored");
    const said = await this.load();
    return [`stored in ${stored.file}: ${stored.paths.join(", ")}`, ...stored.warnings, ...(said === undefined ? [] : [said])].join("\n");
  }

  /** Takes what the files say; what was not stored is gone. */
  async reload(): Promise<string | void> {
    const run = this.robot.welcome.value;
    const { version } = expect(await this.robot.ask({ reload: {} }), "written");
    for (const begun of this.begun.values()) begun.own = { run, version, isReload: true };
    if (this.tuned.value !== null) this.hearOwn(this.tuned.value.reading);
    return this.load();
  }

  /** What was written is shown until everything was asked for again. */
  private async send(changes: Change[]): Promise<void> {
    const run = this.robot.welcome.value;
    const { version } = expect(await this.robot.ask({ write: { changes } }), "written");
    this.written = { run, version };
    this.unanswered = null;
    const tuned = this.tuned.value;
    if (tuned === null) return;
    const isWritten = ({ path }: { path: string }): boolean => changes.some((change) => isWithin(change.path, path));
    const value = changes.reduce((whole, change) => withPart(whole, change.path, change.value), tuned.reading.value);
    for (const path of this.begun.keys()) if (isWritten({ path })) this.begun.set(path, { value: part(value, path), own: { run, version, isReload: false } });
    if (tuned.reading.version >= version) return this.hearOwn(tuned.reading);
    const newer = (leaf: Leaf): Leaf => (isWritten(leaf) ? { ...leaf, provenance: { from: "live", version } } : leaf);
    const parameters = tuned.parameters.map((one): Parameter => (isWritten(one) ? { ...one, value: part(value, one.path), leaf: newer(one.leaf) } : one));
    this.tuned.set({ ...tuned, reading: { value, version, leaves: tuned.reading.leaves.map(newer) }, parameters });
  }

  /** What was sent, and what the robot has, is pending no more; what was typed meanwhile is. */
  private settle(sent: readonly Pick<Parameter, "path" | "value">[]): void {
    const pending = new Map(this.pending.value);
    for (const { path, value } of sent) {
      const draft = pending.get(path);
      if (draft !== undefined && "value" in draft && isSame(draft.value, value)) pending.delete(path);
    }
    if (pending.size < this.pending.value.size) this.setPending(pending);
  }

  /** Nobody sees what was typed for parameters that are not there any more, so that nobody may send it. */
  private forgetWithout(tuned: Tuned): string | void {
    const paths = new Set(tuned.parameters.map(({ path }) => path));
    const gone = [...this.pending.value.keys()].filter((path) => !paths.has(path));
    if (gone.length === 0) return;
    this.setPending(new Map([...this.pending.value].filter(([path]) => paths.has(path))));
    return `not there any more, and what was typed is forgotten: ${gone.join(", ")}`;
  }

  private valueOf(path: string): Json {
    return this.tuned.value?.parameters.find((parameter) => parameter.path === path)?.value ?? null;
  }
}

function describe(reading: Reading, unstored: Unstored, entries: readonly Entry[]): Tuned {
  const byPath = new Map(entries.map((entry) => [entry.path, entry]));
  const parameters = reading.leaves.map((leaf): Parameter => {
    const change = unstored.changes.find(({ path }) => isWithin(leaf.path, path));
    return {
      path: leaf.path,
      leaf,
      value: part(reading.value, leaf.path),
      entry: byPath.get(`parameters.${leaf.path}`),
      isUnstored: change !== undefined,
      stored: change?.stored ?? null,
      isCreationOnly: unstored.creation_only.some((path) => isWithin(path, leaf.path)),
    };
  });
  return { reading, parameters, layers: unstored.layers };
}
