// A panel to drive the robot with keys or thumbs: it walks as long as somebody holds a key, and stands when nobody does.
import { expect } from "../connection/socket";
import { button, complain, make } from "../view/dom";
import type { Context, Panel, PanelKind } from "../panels/panel";
import type { Entry, Json } from "../protocol";
import { taking } from "./values";

/** Shorter than the second after which the robot forgets a wish. */
const PERIOD_MILLISECONDS = 250;

/** Shares of the greatest step, by key. */
const KEYS: Record<string, { name: string; about: string; step: readonly [number, number, number] }> = {
  q: { name: "↺", about: "turn left (Q)", step: [0, 0, 1] },
  w: { name: "▲", about: "ahead (W)", step: [1, 0, 0] },
  e: { name: "↻", about: "turn right (E)", step: [0, 0, -1] },
  a: { name: "◀", about: "to the left (A)", step: [0, 1, 0] },
  s: { name: "▼", about: "back (S)", step: [-1, 0, 0] },
  d: { name: "▶", about: "to the right (D)", step: [0, -1, 0] },
};
const ALIASES: Record<string, string> = { arrowup: "w", arrowdown: "s", arrowleft: "q", arrowright: "e" };
/** Of one step, m, m and rad: what the walk does well (docs/nao.md). */
const LARGEST: readonly [number, number, number] = [0.06, 0.04, 0.3];

class Drive implements Panel {
  readonly content: HTMLElement;
  private readonly held = new Set<string>();
  private readonly pads = new Map<string, HTMLElement>();
  private readonly speed = make("input", { type: "range", min: 0.2, max: 1, step: 0.1, value: 0.7, "aria-label": "share of the largest step" });
  private readonly state = make("output", { class: "muted", "aria-live": "polite" }, "not driving");
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly stops: (() => void)[];
  private timer: number | null = null;
  private walk: string | null = null;
  private motion: string | null = null;

  constructor(private readonly context: Context) {
    const pads = Object.entries(KEYS).map(([key, { name, about }]) => this.pad(key, name, about));
    const motions = ["Stand", "SitDown", "KickLeft", "KickRight", "Release"].map((name) => {
      const about = name === "Release" ? "give the body back to the behaviour" : name;
      return button(name.replace(/([a-z])([A-Z])/, "$1 $2"), about, () => void this.move(name));
    });
    this.content = make(
      "div",
      { class: "scroll drive", tabindex: "0" },
      make("p", { class: "muted" }, "Click here, then hold W A S D, Q E or arrows. The robot stands when you let go or look elsewhere."),
      make("div", { class: "pads" }, ...pads),
      make("div", { class: "bar" }, make("label", {}, "step ", this.speed), this.state),
      make("div", { class: "bar" }, ...motions),
      this.failure,
    );
    this.content.addEventListener("keydown", (event) => this.press(event));
    this.content.addEventListener("keyup", (event) => this.release(keyOf(event)));
    this.content.addEventListener("focusout", (event) => {
      if (!this.content.contains(event.relatedTarget as Node | null)) this.letGo();
    });
    const letGo = (): void => this.letGo();
    window.addEventListener("blur", letGo);
    document.addEventListener("visibilitychange", letGo);
    this.stops = [
      () => window.removeEventListener("blur", letGo),
      () => document.removeEventListener("visibilitychange", letGo),
      context.robot.welcome.watch((welcome) => {
        if (welcome !== null) void this.find();
      }),
      // What was held when the connection went is not held when it comes back.
      context.robot.state.watch((state) => {
        if (state !== "open") this.forget("the connection is lost: the robot stops by itself");
      }),
    ];
  }

  close(): void {
    this.letGo();
    for (const stop of this.stops) stop();
  }

  private pad(key: string, name: string, about: string): HTMLElement {
    const pad = make("button", { type: "button", class: "pad", title: about, "aria-label": about, "aria-pressed": "false" }, name);
    pad.addEventListener("pointerdown", (event) => {
      pad.setPointerCapture(event.pointerId);
      this.hold(key);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) pad.addEventListener(end, () => this.release(key));
    // A finger that rests would open the browser's menu.
    pad.addEventListener("contextmenu", (event) => event.preventDefault());
    this.pads.set(key, pad);
    return pad;
  }

  private async find(): Promise<void> {
    const entries = await this.context.robot.paths.everything().catch((): readonly Entry[] => []);
    this.walk = taking(entries, "Step")?.path ?? null;
    this.motion = taking(entries, "MotionRequest")?.path ?? null;
  }

  private press(event: KeyboardEvent): void {
    const key = keyOf(event);
    const isPad = event.target instanceof HTMLButtonElement && (event.key === " " || event.key === "Enter");
    if (!(key in KEYS) || event.target === this.speed || isPad || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    if (!event.repeat) this.hold(key);
  }

  private hold(key: string): void {
    this.held.add(key);
    this.mark();
    void this.ask();
    this.timer ??= window.setInterval(() => void this.ask(), PERIOD_MILLISECONDS);
  }

  private release(key: string): void {
    if (!this.held.delete(key)) return;
    this.mark();
    if (this.held.size === 0) this.letGo();
    else void this.ask();
  }

  /** Nobody drives any more: the robot stands, and is not sent on to wherever its behaviour wants it. */
  private letGo(): void {
    if (this.timer === null) return;
    this.forget("standing");
    void this.move("Stand");
  }

  private forget(text: string): void {
    if (this.timer !== null) window.clearInterval(this.timer);
    this.timer = null;
    this.held.clear();
    this.mark();
    this.state.textContent = text;
  }

  private mark(): void {
    for (const [key, pad] of this.pads) pad.setAttribute("aria-pressed", String(this.held.has(key)));
  }

  private async ask(): Promise<void> {
    if (this.held.size === 0) return;
    const share = Number(this.speed.value);
    const sum = [0, 1, 2].map((at) => share * (LARGEST[at] as number) * [...this.held].reduce((all, key) => all + (KEYS[key]?.step[at] ?? 0), 0));
    const [forward, left, turn] = sum as [number, number, number];
    const said = await this.call(this.walk, { forward, left, turn });
    if (said === null || this.held.size === 0) return;
    const step = said as { [key: string]: number };
    this.state.textContent = `driving: ${(100 * (step["forward"] ?? 0)).toFixed(1)} cm ahead, ${(100 * (step["left"] ?? 0)).toFixed(1)} cm left, ${(((step["turn"] ?? 0) * 180) / Math.PI).toFixed(0)}° a step`;
  }

  private async move(motion: string): Promise<void> {
    if ((await this.call(this.motion, motion)) !== null) this.state.textContent = motion === "Release" ? "not driving" : motion;
  }

  private async call(path: string | null, argument: Json): Promise<Json> {
    if (path === null) return null;
    try {
      const said = expect(await this.context.robot.ask({ call: { path, argument, timeout: 1 } }), "called");
      complain(this.failure, null);
      return said;
    } catch (error) {
      complain(this.failure, error);
      return null;
    }
  }
}

function keyOf(event: KeyboardEvent): string {
  const key = event.key.toLowerCase();
  return ALIASES[key] ?? key;
}

export const drive: PanelKind = {
  kind: "drive",
  name: "Drive",
  open: (context) => new Drive(context),
  offered: (entries) => taking(entries, "Step") !== undefined,
};
