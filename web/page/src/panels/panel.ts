// Owns what a panel is: one element, fed by the robot's store, with settings that the layout keeps.
import type { Entry } from "../protocol";
import type { Arrangement, Settings } from "../store/layout";
import type { Robot } from "../store/robot";
import type { Known } from "../store/robots";

export interface Context {
  /** The one that the panel shows. */
  readonly robot: Robot;
  /** All that the page may show, for panels that say `showsRobots`. */
  readonly robots: readonly Known[];
  /** The panel's one among them. */
  readonly known: Known;
  readonly arrangement: Arrangement;
  readonly settings: Settings;
  /** Keeps settings for the next time. */
  save(settings: Settings): void;
  /** Names what is shown. */
  title(text: string): void;
}

export interface Panel {
  readonly content: HTMLElement;
  /** Stand in the panel's head. */
  readonly tools?: readonly HTMLElement[];
  /** Ends subscriptions and timers. */
  close(): void;
  /** A path was dropped on it. */
  accept?(path: string): void;
  /** Its place is larger or smaller now. */
  resized?(): void;
}

export interface PanelKind {
  /** In layouts: never changes. */
  readonly kind: string;
  readonly name: string;
  open(context: Context): Panel;
  /** Whether it shows other robots beside its own: it is opened anew where there are others than before. */
  readonly showsRobots?: true;
  /** Whether this robot has what the panel shows; absent: every robot has. */
  offered?(entries: readonly Entry[]): boolean;
}

/** What the browser hands from where a drag began to where it ends. */
export const DRAGGED_PATH = "application/x-hulk-path";

/** A setting that is a text. */
export function textSetting(settings: Settings, name: string, otherwise = ""): string {
  const value = settings[name];
  return typeof value === "string" ? value : otherwise;
}

/** A setting that is a number. */
export function numberSetting(settings: Settings, name: string, otherwise: number): number {
  const value = settings[name];
  return typeof value === "number" ? value : otherwise;
}
