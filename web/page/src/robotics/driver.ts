// Owns what is asked of a robot that somebody drives: to walk while something is held, and to stand once nothing is.
import { expect } from "../connection/socket";
import type { Json } from "../protocol";
import type { Robot } from "../store/robot";

/** Shorter than the second after which the robot forgets a wish. */
const PERIOD_MILLISECONDS = 250;
/** By then the robot has forgotten the last wish, wherever the answer is. */
const LATE_MILLISECONDS = 2000;

/** Ahead, to the left, turn: in m, m and rad, or in shares of the largest. */
export type Step = readonly [number, number, number];

/** Shares of the greatest step, by key. */
export const KEYS: Record<string, { name: string; about: string; step: Step }> = {
  q: { name: "↺", about: "turn left (Q)", step: [0, 0, 1] },
  w: { name: "▲", about: "ahead (W)", step: [1, 0, 0] },
  e: { name: "↻", about: "turn right (E)", step: [0, 0, -1] },
  a: { name: "◀", about: "to the left (A)", step: [0, 1, 0] },
  s: { name: "▼", about: "back (S)", step: [-1, 0, 0] },
  d: { name: "▶", about: "to the right (D)", step: [0, -1, 0] },
};
/** Of one step, m, m and rad: what the walk does well (docs/nao.md). */
const LARGEST: Step = [0.06, 0.04, 0.3];

export interface DriverListener {
  /** Share of the largest step. */
  share(): number;
  /** Other keys are held than before. */
  held(): void;
  /** What the robot does. */
  state(text: string): void;
  /** What was in the way of the last call; null: nothing was. */
  failed(reason: unknown): void;
}

export class Driver {
  /** Paths of the procedures; null: the robot has none. */
  walk: string | null = null;
  motion: string | null = null;
  private readonly keys = new Set<string>();
  private timer: ReturnType<typeof setInterval> | null = null;
  /** When the step was asked for that has no answer yet. */
  private asked: number | null = null;
  /** Somebody wanted another step while the robot had not answered. */
  private isDue = false;

  constructor(
    private readonly robot: Pick<Robot, "ask">,
    private readonly listener: DriverListener,
  ) {}

  get held(): ReadonlySet<string> {
    return this.keys;
  }

  hold(key: string): void {
    this.keys.add(key);
    this.listener.held();
    void this.ask();
    this.timer ??= setInterval(() => void this.ask(), PERIOD_MILLISECONDS);
  }

  release(key: string): void {
    if (!this.keys.delete(key)) return;
    this.listener.held();
    if (this.keys.size === 0) this.letGo();
    else void this.ask();
  }

  /** Nobody drives any more: the robot stands, and is not sent on to wherever its behaviour wants it. */
  letGo(): void {
    if (this.timer === null) return;
    this.forget("standing");
    void this.move("Stand");
  }

  forget(text: string): void {
    if (this.timer !== null) clearInterval(this.timer);
    this.timer = null;
    this.keys.clear();
    this.listener.held();
    this.listener.state(text);
  }

  async move(motion: string): Promise<void> {
    if ((await this.call(this.motion, motion)) !== null) this.listener.state(motion === "Release" ? "not driving" : motion);
  }

  /**
   * One step at a time: the robot takes one in each cycle, so that several which come together after a network that
   * stalled would be taken after the wish to stand which was sent behind them. Over a link that takes longer than the
   * robot remembers a wish, it walks and stands in turn.
   */
  private async ask(): Promise<void> {
    if (this.keys.size === 0) return;
    if (this.asked !== null) {
      this.isDue = true;
      if (isLate(this.asked)) this.listener.state("the robot does not answer: it stops by itself");
      return;
    }
    const asked = performance.now();
    this.asked = asked;
    this.isDue = false;
    const share = this.listener.share();
    const sum = LARGEST.map((largest, at) => share * largest * [...this.keys].reduce((all, key) => all + (KEYS[key]?.step[at] ?? 0), 0));
    const [forward, left, turn] = sum as [number, number, number];
    const said = await this.call(this.walk, { forward, left, turn });
    this.asked = null;
    if (this.keys.size === 0) return;
    if (said !== null) this.listener.state(driving(said as { [key: string]: number }));
    else if (isLate(asked)) this.listener.state("");
    if (this.isDue) void this.ask();
  }

  private async call(path: string | null, argument: Json): Promise<Json> {
    if (path === null) return null;
    try {
      const said = expect(await this.robot.ask({ call: { path, argument, timeout: 1 } }), "called");
      this.listener.failed(null);
      return said;
    } catch (error) {
      this.listener.failed(error);
      return null;
    }
  }
}

function isLate(asked: number): boolean {
  return performance.now() - asked >= LATE_MILLISECONDS;
}

function driving(step: { [key: string]: number }): string {
  const [forward, left, turn] = [step["forward"] ?? 0, step["left"] ?? 0, step["turn"] ?? 0];
  return `driving: ${(100 * forward).toFixed(1)} cm ahead, ${(100 * left).toFixed(1)} cm left, ${((turn * 180) / Math.PI).toFixed(0)}° a step`;
}
