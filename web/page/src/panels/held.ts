// Owns what a plot shows while it is paused: a part of the time with the points that there were, whatever becomes of the curves.
import { Series } from "./series";

/** From one time to another, in seconds. */
export type Part = [number, number];

export class Held {
  private held: { part: Part; points: Map<Series, Series>; isEarlier: boolean } | null = null;

  /** Null: the plot goes on. */
  get part(): Part | null {
    return this.held?.part ?? null;
  }

  /** Whether the robot has begun another run since then. */
  get isEarlier(): boolean {
    return this.held?.isEarlier ?? false;
  }

  /** Of the points that there are now. */
  hold(part: Part, curves: readonly Series[]): void {
    this.held = { part, points: new Map(curves.map((one) => [one, one.copy()])), isEarlier: false };
  }

  /** Another part of what is held; where nothing is, of the points that there are now. */
  zoom(part: Part, curves: readonly Series[]): void {
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

  /** The points of a curve that are to be drawn; of one that came later, none that lie on another clock. */
  shown(curve: Series): Series {
    if (this.held === null) return curve;
    return this.held.points.get(curve) ?? (this.held.isEarlier ? new Series() : curve);
  }
}
