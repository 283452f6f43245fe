// Owns what a panel of robotics reads of its robot: some values by names of its own, wherever the robot has them.
import type { Decoded } from "../connection/binary";
import type { Entry } from "../protocol";
import type { Robot } from "../store/robot";
import type { Sample } from "../store/subscriptions";

/** Enough to find the value of the cycle that an image is about. */
const KEPT = 8;

export class Values {
  private readonly samples = new Map<string, Sample[]>();
  private readonly stops = new Map<string, () => void>();
  private isClosed = false;

  constructor(
    private readonly robot: Robot,
    private readonly changed: () => void,
  ) {}

  /** From now on `name` is the value at this path; null: it is none. */
  set(name: string, path: string | null, rate: number): void {
    this.stops.get(name)?.();
    this.stops.delete(name);
    this.samples.delete(name);
    // Whoever waited for the robot meanwhile may be late.
    if (path === null || this.isClosed) return;
    const sample = (next: Sample): void => {
      const kept = this.samples.get(name) ?? [];
      this.samples.set(name, [...kept.slice(1 - KEPT), next]);
      this.changed();
    };
    this.stops.set(name, this.robot.subscriptions.watch({ path, rate, encoding: "binary" }, { sample }));
  }

  /** The newest value; undefined: there was none. */
  get(name: string): Decoded | undefined {
    return this.samples.get(name)?.at(-1)?.value;
  }

  /** The value of this cycle, or the one that came closest before it. */
  of(name: string, cycle: number): Decoded | undefined {
    const kept = this.samples.get(name) ?? [];
    return (kept.findLast((sample) => sample.cycle <= cycle) ?? kept[0])?.value;
  }

  /** When the newest value was made, in nanoseconds of the robot's clock. */
  time(name: string): number | null {
    return this.samples.get(name)?.at(-1)?.time ?? null;
  }

  close(): void {
    this.isClosed = true;
    for (const stop of this.stops.values()) stop();
    this.stops.clear();
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
