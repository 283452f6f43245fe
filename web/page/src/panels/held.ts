// Owns what a plot shows while it is paused: a part of the time with the points that there were, whatever becomes of the curves.
import { Series } from "./series";

/** From one time to another, in seconds. */
export type Part = [number, number];

/** What of a curve there is. */
export interface Points {
  readonly series: Series;
  /** How many values did not come through. */
  readonly missing: number;
}

export class Held {
  private held: { part: Part; points: Map<Series, Points>; isEarlier: boolean } | null = null;

  /** Null: the plot goes on. */
  get part(): Part | null {
    return this.held?.part ?? null;
  }

  /** Whether the robot has begun another run since then. */
  get isEarlier(): boolean {
    return this.held?.isEarlier ?? false;
  }

  /** Of the points that there are now. */
  hold(part: Part, curves: readonly Points[]): void {
    this.held = { part, points: new Map(curves.map(({ series, missing }) => [series, { series: series.copy(), missing }])), isEarlier: false };
  }

  /** Another part of what is held; where nothing is, of the points that there are now. */
  zoom(part: Part, curves: readonly Points[]): void {
    if (this.held === null) this.hold(part, curves);
    else this.held.part = part;
  }

  go(): void {
    this.held = null;
  }

  /** Another run begins, whose points lie on another clock. */
  endRun(): void {
    if (this.held === null) return;
    this.held.isEarlier = true;
  }

  /** What of a curve is to be shown; of one that came later, nothing that lies on another clock. */
  shown(curve: Points): Points {
    if (this.held === null) return curve;
    return this.held.points.get(curve.series) ?? (this.held.isEarlier ? { series: new Series(), missing: 0 } : curve);
  }
}
