// Owns one curve of a plot: whose number it draws, how layouts and files name it, and its points on the clock of the panel's robot.
import type { Json } from "../protocol";
import type { Settings } from "../store/layout";
import type { Robot } from "../store/robot";
import type { Known } from "../store/robots";
import { COLORS, height, robotColor, Series } from "./series";

/** As a layout keeps it. */
export interface Wanted {
  path: string;
  /** The address of its robot; absent: whichever robot the panel shows. */
  robot?: string;
}

export interface Look {
  color: string;
  /** Lengths of strokes and gaps in px; empty: one stroke. */
  dash: number[];
}

/** Curves of one robot beside those of others: all in its colour, told apart by their strokes. */
const DASHES = [[], [12, 4], [3, 3], [12, 4, 3, 4], [12, 4, 3, 4, 3, 4]];

const NO_NUMBER = "this is no number: a curve shows numbers and flags, and so may parts of it";

/** Of a robot that this page may not show: it has no place among the others. */
const STRANGER = "#808080";

/** What a layout has of a plot's curves; what is none is left out. A path alone is one of the panel's robot. */
export function wantedIn(settings: Settings): Wanted[] {
  const kept = settings["paths"];
  return (Array.isArray(kept) ? kept : []).flatMap((one): Wanted[] => {
    if (typeof one === "string") return [{ path: one }];
    if (typeof one !== "object" || one === null || Array.isArray(one)) return [];
    const { path, robot } = one;
    return typeof path === "string" && typeof robot === "string" ? [{ path, robot }] : [];
  });
}

/** What `wantedIn` reads; pages from before plots had several robots read the paths of their own. */
export function kept({ path, robot }: Wanted): Json {
  return robot === undefined ? path : { path, robot };
}

/** How files of curves name it: paths have no spaces. */
export function nameIn({ path, robot }: Wanted): string {
  return robot === undefined ? path : `${robot} ${path}`;
}

/** Whether a plot has curves of robots that it names: then each has its robot's colour. */
export function isShared(curves: readonly { wanted: Wanted }[]): boolean {
  return curves.some(({ wanted }) => wanted.robot !== undefined);
}

/** Of each curve: a colour of its own, or that of its robot, with other strokes for each one of that robot. */
export function looksOf(curves: readonly { wanted: Wanted; known: Known | null }[]): Look[] {
  if (!isShared(curves)) return curves.map((_, at) => ({ color: COLORS[at % COLORS.length] as string, dash: [] }));
  return curves.map(({ known }, at) => {
    const before = curves.slice(0, at).filter((other) => other.known === known).length;
    return { color: known === null ? STRANGER : robotColor(known.at), dash: DASHES[before % DASHES.length] as number[] };
  });
}

/** The same number of another run: dashed where it is drawn through itself, else paler. */
export function lookOfOtherRun({ color, dash }: Look): Look {
  return dash.length === 0 ? { color, dash: [4, 4] } : { color: `${color}80`, dash };
}

export class Curve {
  readonly series = new Series();
  /** Why it has no points, or no further ones. */
  failure: string | null = null;
  /** Cycles that did not come through: there are gaps. */
  missing = 0;
  private readonly stops: (() => void)[] = [];
  /** From its robot's clock to that of the panel's robot, in seconds; null: not known now. */
  private shift: number | null = 0;

  /** `known`: the robot that it is of; null: this page may not show it. `changed` hears of points, `told` of failures and of robots that come and go. */
  constructor(
    readonly wanted: Wanted,
    readonly known: Known | null,
    own: Robot,
    changed: () => void,
    private readonly told: () => void,
  ) {
    if (known === null) {
      this.failure = `${wanted.robot} is not among the robots that this page may show`;
      return;
    }
    const { robot } = known;
    if (robot !== own) {
      const align = (shift: number | null): void => {
        this.shift = shift;
        told();
      };
      this.stops.push(own.shiftFrom(robot).watch(align));
    }
    this.stops.push(
      robot.state.watch((state) => {
        if (state === "waiting") this.series.interrupt();
        told();
      }),
      robot.subscriptions.watch(
        { path: wanted.path },
        {
          sample: ({ time, value }) => {
            const wrong = value === null || height(value) !== null ? null : NO_NUMBER;
            if (wrong !== this.failure) this.fail(wrong);
            if (this.shift === null) return;
            this.series.add(time / 1e9 + this.shift, height(value));
            changed();
          },
          lost: (updates) => {
            this.missing += updates;
            this.series.interrupt();
            told();
          },
          refused: (reason) => this.fail(reason),
        },
      ),
    );
  }

  /** The panel's robot has a connection, as `Series.begin` takes it; what did not come through of another run is missed no more. */
  begin(isSameRun: boolean | null, time: number): boolean {
    const isOther = this.series.begin(isSameRun, time);
    if (isOther && this.missing > 0) {
      this.missing = 0;
      this.told();
    }
    return isOther;
  }

  /** Whether its robot is there, and it is known where its points belong. */
  get isThere(): boolean {
    return this.shift !== null && this.known?.robot.state.value === "open";
  }

  close(): void {
    for (const stop of this.stops) stop();
  }

  private fail(reason: string | null): void {
    this.failure = reason;
    this.told();
  }
}
