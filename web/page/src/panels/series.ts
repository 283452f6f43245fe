// Owns the points of one curve, and how curves with times of their own come to lie on one axis.

/** Six minutes at 83 Hz. */
const POINTS = 30000;

export class Series {
  /** In seconds of the robot's clock, rising. */
  times: number[] = [];
  values: (number | null)[] = [];

  /** The time of a recording goes back, too: what lay behind it comes again. */
  add(time: number, value: number | null): void {
    const last = this.times[this.times.length - 1];
    if (last !== undefined && time <= last) {
      if (time === last) return;
      this.times.length = this.values.length = this.from(time);
    }
    this.times.push(time);
    this.values.push(value);
    if (this.times.length > POINTS * 1.1) {
      this.times = this.times.slice(-POINTS);
      this.values = this.values.slice(-POINTS);
    }
  }

  /** What comes next is not joined to what was: there was no connection between. */
  interrupt(): void {
    const last = this.times[this.times.length - 1];
    if (last !== undefined && this.values[this.values.length - 1] !== null) this.add(last + 1e-6, null);
  }

  /**
   * A connection begins at this time of the robot's clock. Points of another run lie on another clock; where nobody knows
   * (null) points that are still to come do. Whether it was taken for another run.
   */
  begin(isSameRun: boolean | null, time: number): boolean {
    if (isSameRun ?? this.from(time) === this.times.length) return false;
    this.times = [];
    this.values = [];
    return true;
  }

  /** The points that there are now, whatever comes or goes. */
  copy(): Series {
    const copy = new Series();
    [copy.times, copy.values] = [[...this.times], [...this.values]];
    return copy;
  }

  /** The first point that is not before a time. */
  from(time: number): number {
    let [low, high] = [0, this.times.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.times[middle] ?? 0) < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

/** All curves from one time to another over one axis; `undefined` where a curve has no point at that time. */
export function align(series: readonly Series[], begin: number, end: number): [number[], ...(number | null | undefined)[][]] {
  const cursors = series.map((one) => one.from(begin));
  const ends = series.map((one) => one.from(end + 1e-9));
  const times: number[] = [];
  const columns: (number | null | undefined)[][] = series.map(() => []);
  for (;;) {
    let time = Infinity;
    series.forEach((one, at) => {
      const cursor = cursors[at] as number;
      if (cursor < (ends[at] as number)) time = Math.min(time, one.times[cursor] as number);
    });
    if (time === Infinity) return [times, ...columns];
    times.push(time);
    series.forEach((one, at) => {
      const cursor = cursors[at] as number;
      const isHere = cursor < (ends[at] as number) && one.times[cursor] === time;
      (columns[at] as (number | null | undefined)[]).push(isHere ? one.values[cursor] : undefined);
      if (isHere) cursors[at] = cursor + 1;
    });
  }
}

/** The curves of a file that a plot has saved, by path; what is no number is a gap. */
export function readCurves(text: string): Map<string, Series> {
  const [head, ...rows] = text.trim().split(/\r?\n/).map((row) => row.split(","));
  const curves = new Map<string, Series>();
  if (head?.[0] !== "time") return curves;
  for (const path of head.slice(1)) curves.set(path, new Series());
  for (const [time, ...values] of rows) {
    [...curves.values()].forEach((series, at) => {
      const value = values[at];
      if (value !== undefined && value !== "" && Number.isFinite(Number(time)) && Number.isFinite(Number(value))) series.add(Number(time), Number(value));
    });
  }
  return curves;
}

/** Why nothing of a file can be compared with these curves; null: something can. */
export function incomparable(others: ReadonlyMap<string, Series>, names: readonly string[]): string | null {
  if (others.size === 0) return "this file has no curves: save some with CSV";
  if (names.some((name) => others.has(name))) return null;
  return `nothing of this file is in this plot: add one of ${[...others.keys()].join(", ")}`;
}

/** What a curve can show of a value: numbers, and flags as 0 and 1. */
export function height(value: unknown): number | null {
  if (typeof value === "number") return value;
  if (typeof value === "bigint") return Number(value);
  return typeof value === "boolean" ? Number(value) : null;
}

/** Okabe and Ito's colours: told apart by colour-blind people, on light and on dark paper. */
export const COLORS = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#8a7b00", "#7a6fd0"];

/** Of robots side by side: not the ball's colour first, and none of them green on a field before all others. */
const ROBOT_COLORS = [0, 3, 5, 7, 4, 6, 2].map((at) => COLORS[at] as string);

/** The colour of the robot at this place of the list of robots. */
export function robotColor(at: number): string {
  return ROBOT_COLORS[at % ROBOT_COLORS.length] as string;
}

/** The robot in a list to choose from: there is place for the letter, the address is read in the open list. */
export function robotChoice({ at, address }: { at: number; address: string }): string {
  return `${robotMark(at)}${"\u00a0".repeat(6)}${address}`;
}

/** The letter of the robot at this place, for whom colours are not enough: A to Z, then numbers. */
export function robotMark(at: number): string {
  return at < 26 ? String.fromCharCode(65 + at) : String(at + 1);
}
