// Owns what a panel of robotics reads of its robot: some values by names of its own, wherever the robot has them.
import type { Decoded } from "../connection/binary";
import type { Entry, Welcome } from "../protocol";
import type { Robot } from "../store/robot";
import { isSameRun } from "../store/run";
import type { Sample } from "../store/subscriptions";

/** Enough to find the value of the cycle that an image is about. */
const KEPT = 8;
/** In ns: values of other cycles than the image's that are as near as their rate lets them are of what it shows, and later ones are not. */
const SLACK = 0.25e9;

/** A value that is watched. */
interface Watched {
  path: string;
  rate: number;
  /** Oldest first. */
  samples: Sample[];
  stop(): void;
}

export class Values {
  private readonly watched = new Map<string, Watched>();
  private run: Welcome | null = null;
  private readonly stop: () => void;
  private isClosed = false;

  constructor(
    private readonly robot: Pick<Robot, "subscriptions" | "welcome">,
    private readonly changed: () => void,
  ) {
    this.stop = robot.welcome.watch((welcome) => this.goOnWith(welcome));
  }

  /** From now on `name` is the value at this path; null: it is none. */
  set(name: string, path: string | null, rate: number): void {
    const before = this.watched.get(name);
    // What is subscribed is so on the next connection, too.
    if (before !== undefined && before.path === path && before.rate === rate) return;
    before?.stop();
    this.watched.delete(name);
    // Whoever waited for the robot meanwhile may be late.
    if (path === null || this.isClosed) return;
    const watched: Watched = { path, rate, samples: [], stop: () => undefined };
    this.watched.set(name, watched);
    const sample = (next: Sample): void => {
      watched.samples = [...watched.samples.slice(1 - KEPT), next];
      this.changed();
    };
    watched.stop = this.robot.subscriptions.watch({ path, rate, encoding: "binary" }, { sample });
  }

  /** The newest value; undefined: there was none. */
  get(name: string): Decoded | undefined {
    return this.watched.get(name)?.samples.at(-1)?.value;
  }

  /** The value of the cycle of an image, or the one that came closest before it; undefined: there is none of about that time. */
  of(name: string, { cycle, time }: Pick<Sample, "cycle" | "time">): Decoded | undefined {
    const watched = this.watched.get(name);
    if (watched === undefined) return undefined;
    const near = watched.samples.filter((sample) => Math.abs(sample.time - time) <= 1e9 / watched.rate + SLACK);
    return (near.findLast((sample) => sample.cycle <= cycle) ?? near[0])?.value;
  }

  /** When the newest value was made, in nanoseconds of the robot's clock. */
  time(name: string): number | null {
    return this.watched.get(name)?.samples.at(-1)?.time ?? null;
  }

  close(): void {
    this.isClosed = true;
    this.stop();
    for (const { stop } of this.watched.values()) stop();
    this.watched.clear();
  }

  /** Values of another run are none of its own. */
  private goOnWith(welcome: Welcome | null): void {
    if (welcome === null) return;
    if (isSameRun(this.run, welcome) !== true) for (const watched of this.watched.values()) watched.samples = [];
    this.run = welcome;
  }
}

/** The output that goes by this name; where none does, the first one of this type. */
export function output(entries: readonly Entry[], name: string, type: string): Entry | undefined {
  const best = ofType(entries, type, name);
  return best !== undefined && isNamed(best, name) ? best : (named(entries, name) ?? best);
}

/** A main output with this type, `Option` or not, as people write it: the one with this name, or the first. */
export function ofType(entries: readonly Entry[], type: string, name = ""): Entry | undefined {
  const wanted = [type, `Option<${type}>`];
  const found = entries.filter((entry) => isWhole(entry) && wanted.includes(entry.type ?? ""));
  return found.find((entry) => isNamed(entry, name)) ?? found[0];
}

/** The entry of an output with this name, of any instance. */
export function named(entries: readonly Entry[], name: string): Entry | undefined {
  return entries.find((entry) => isNamed(entry, name));
}

/** The procedure that takes this type. */
export function taking(entries: readonly Entry[], request: string): Entry | undefined {
  return entries.find((entry) => entry.kind === "procedure" && entry.request === request);
}

function isNamed(entry: Entry, name: string): boolean {
  return new RegExp(`^[^.]+\\.(main|additional)_outputs\\.${name.replaceAll(".", "\\.")}$`).test(entry.path);
}

/** Main outputs, not parts of others. */
function isWhole(entry: Entry): boolean {
  return entry.kind === "main_output" && entry.path.split(".").length === 3;
}
