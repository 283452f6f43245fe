// A panel to drive the robot with keys or thumbs: it walks as long as somebody holds a key, and stands when nobody does.
import { button, complain, make } from "../view/dom";
import type { Context, Panel, PanelKind } from "../panels/panel";
import type { Entry } from "../protocol";
import { Driver, KEYS } from "./driver";
import { taking } from "./values";

const ALIASES: Record<string, string> = { arrowup: "w", arrowdown: "s", arrowleft: "q", arrowright: "e" };
const IDLE = "not driving";
const LOST = "the connection is lost: the robot stops by itself";

class Drive implements Panel {
  readonly content: HTMLElement;
  private readonly driver: Driver;
  private readonly pads = new Map<string, HTMLElement>();
  private readonly speed = make("input", { type: "range", min: 0.2, max: 1, step: 0.1, value: 0.7, "aria-label": "share of the largest step" });
  private readonly state = make("output", { class: "muted", "aria-live": "polite" }, IDLE);
  private readonly failure = make("p", { class: "failure", hidden: true });
  private readonly stops: (() => void)[];

  constructor(private readonly context: Context) {
    this.driver = new Driver(context.robot, {
      share: () => Number(this.speed.value),
      held: () => this.mark(),
      state: (text) => (this.state.textContent = text),
      failed: (reason) => complain(this.failure, reason),
    });
    const pads = Object.entries(KEYS).map(([key, { name, about }]) => this.pad(key, name, about));
    const motions = ["Stand", "SitDown", "KickLeft", "KickRight", "Release"].map((name) => {
      const about = name === "Release" ? "give the body back to the behaviour" : name;
      return button(name.replace(/([a-z])([A-Z])/, "$1 $2"), about, () => void this.driver.move(name));
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
    this.content.addEventListener("keyup", (event) => this.driver.release(keyOf(event)));
    this.content.addEventListener("focusout", (event) => {
      if (!this.content.contains(event.relatedTarget as Node | null)) this.driver.letGo();
    });
    const letGo = (): void => this.driver.letGo();
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
        if (state === "open") this.resume();
        else if (context.robot.welcome.value !== null) this.driver.forget(LOST);
      }),
    ];
  }

  close(): void {
    this.driver.letGo();
    for (const stop of this.stops) stop();
  }

  private pad(key: string, name: string, about: string): HTMLElement {
    const pad = make("button", { type: "button", class: "pad", title: about, "aria-label": about, "aria-pressed": "false" }, name);
    pad.addEventListener("pointerdown", (event) => {
      pad.setPointerCapture(event.pointerId);
      this.driver.hold(key);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) pad.addEventListener(end, () => this.driver.release(key));
    // A finger that rests would open the browser's menu.
    pad.addEventListener("contextmenu", (event) => event.preventDefault());
    this.pads.set(key, pad);
    return pad;
  }

  private async find(): Promise<void> {
    const entries = await this.context.robot.paths.everything().catch((): readonly Entry[] => []);
    this.driver.walk = taking(entries, "Step")?.path ?? null;
    this.driver.motion = taking(entries, "MotionRequest")?.path ?? null;
  }

  private press(event: KeyboardEvent): void {
    const key = keyOf(event);
    const isPad = event.target instanceof HTMLButtonElement && (event.key === " " || event.key === "Enter");
    if (!(key in KEYS) || event.target === this.speed || isPad || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    if (!event.repeat) this.driver.hold(key);
  }

  private resume(): void {
    if (this.state.textContent === LOST) this.state.textContent = IDLE;
  }

  private mark(): void {
    for (const [key, pad] of this.pads) pad.setAttribute("aria-pressed", String(this.driver.held.has(key)));
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
