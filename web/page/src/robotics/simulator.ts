// A panel that is the hand in a simulated world: puts ball and robot elsewhere, pushes, presses, whistles.
import { expect } from "../connection/socket";
import { button, eachFrame, make, select } from "../view/dom";
import { Failures } from "../view/failures";
import type { Context, Panel, PanelKind } from "../panels/panel";
import { COLORS } from "../panels/series";
import type { Json } from "../protocol";
import { Chart } from "./chart";
import { RULES } from "./field";
import { fields, list, outOf, type Point } from "./geometry";
import { disturb, DISTURB, watchTruth, type Truth } from "./truth";

const PENALTIES = ["PlayerPushing", "LeavingTheField", "IllegalPosition", "LocalGameStuck", "RequestForPickup"];
/** Robots have it whose world goes on as clients wish: those of a scenario. */
const SPEED = "framework.procedures.speed";
/** The same of them: what is played, what might be, and what is played from its beginning instead. */
const SCENARIO = "framework.procedures.scenario";
/** In times of real time; the last one is more than a machine can. */
const SPEEDS: readonly [string, number][] = [["hold", 0], ["0.1 ×", 0.1], ["0.25 ×", 0.25], ["0.5 ×", 0.5], ["1 ×", 1], ["2 ×", 2], ["4 ×", 4], ["at full speed", 1000]];
/** Others may change the speed of a world that all its robots share: asked again after so many looks at the truth. */
const LOOKS = 10;
/** A finger is wider than a ball on a small field, px. */
const REACH = 24;

/** Of a drag: what was held is put down, or left where it was. */
const ENDS = ["pointerup", "pointercancel"] as const;

type Thing = "ball" | "robot" | "heading";

class Simulator implements Panel {
  readonly content: HTMLElement;
  private readonly draw = eachFrame(() => this.paint());
  private readonly canvas = make("canvas", { class: "field", role: "img", "aria-label": "the simulated world: drag ball and robot", tabindex: "0" });
  private readonly chart = new Chart(this.canvas, this.draw);
  private readonly state = make("output", { class: "muted" });
  private readonly failures = new Failures();
  private readonly speed: HTMLSelectElement;
  private readonly scenario = make("select", { "aria-label": "which scenario is played" });
  private readonly scenarios = make("span", { hidden: true }, this.scenario, button("Play", "play this scenario from its beginning", () => void this.play(this.scenario.value)));
  private readonly strength = make("input", { type: "number", min: 0.5, max: 10, step: 0.5, value: 3, "aria-label": "strength of a push in N s" });
  private readonly stop: () => void;
  private truth: Truth | null = null;
  /** What the world said last. */
  private confirmed = 1;
  private isWorldAsked = false;
  private looks = 0;
  private dragged: { thing: Thing; at: Point } | null = null;

  constructor(private readonly context: Context) {
    const push = (name: string, about: string, forward: number, left: number): HTMLElement =>
      button(name, about, () => {
        const strength = Number(this.strength.value);
        this.deed({ push: [forward * strength, left * strength, 0] });
      });
    const press = (name: string, what: string): HTMLElement => button(name, `somebody presses it: ${what}`, () => this.deed({ press: { button: what, lasts: 0.2 } }));
    const names = SPEEDS.map(([name]) => name);
    this.speed = select(names, "1 ×", "how fast the world goes on", () => void this.goOn(SPEEDS[this.speed.selectedIndex]?.[1] ?? null));
    this.speed.hidden = true;
    this.content = make(
      "div",
      { class: "map" },
      make("div", { class: "bar" }, make("span", { class: "muted" }, "Drag the ball, the robot, or its nose."), make("span", { class: "space" }), this.state, this.scenarios, this.speed),
      this.canvas,
      make(
        "div",
        { class: "bar" },
        make("label", {}, "push ", this.strength, " N s"),
        push("↑", "push it forwards", 1, 0),
        push("↓", "push it backwards", -1, 0),
        push("←", "push it to its left", 0, 1),
        push("→", "push it to its right", 0, -1),
        button("Roll ball", "the ball rolls at 1 m/s towards the robot", () => this.roll()),
        press("Chest", "chest"),
        press("Head", "head"),
        button("Whistle", "somebody whistles", () => this.deed({ whistle: true })),
        this.penalties(),
      ),
      this.failures.element,
    );
    this.canvas.addEventListener("pointerdown", (event) => this.grasp(event));
    // What begins anew goes on at a speed of its own, and may be another scenario.
    const stopState = context.robot.state.watch(() => (this.isWorldAsked = false));
    const stopTruth = watchTruth(context.robot, (truth) => {
      this.truth = truth;
      // Who may not write hears neither.
      if (truth !== null) {
        this.looks += 1;
        if (!this.isWorldAsked) void this.askWorld();
        else if (!this.speed.hidden && this.looks % LOOKS === 0 && document.activeElement !== this.speed) void this.goOn(null);
      }
      this.draw();
    });
    this.stop = () => {
      stopState();
      stopTruth();
    };
  }

  close(): void {
    this.stop();
  }

  resized(): void {
    this.draw();
  }

  /** The list goes back to its beginning: the same penalty may be given again. */
  private penalties(): HTMLElement {
    const begin = "penalise …";
    const element = select([begin, ...PENALTIES], begin, "the referee takes the robot out, where a game is played", (penalty) => {
      element.value = begin;
      if (penalty !== begin) this.deed({ penalise: penalty });
    });
    return element;
  }

  private deed(deed: { [key: string]: Json }): void {
    disturb(this.context.robot, deed).then(
      () => this.failures.did(null),
      (error: unknown) => this.failures.did(error),
    );
  }

  private async askWorld(): Promise<void> {
    this.isWorldAsked = true;
    const { paths } = this.context.robot;
    try {
      if ((await paths.find(SPEED)) !== undefined) await this.goOn(null);
      if ((await paths.find(SCENARIO)) !== undefined) await this.play(null);
    } catch {
      // The next look at the truth asks again.
      this.isWorldAsked = false;
    }
  }

  /** This scenario in place of the one that is played; `null`: that one goes on. */
  private async play(wished: string | null): Promise<void> {
    try {
      const programme = fields(expect(await this.context.robot.ask({ call: { path: SCENARIO, argument: wished } }), "called"));
      const choices = list(programme?.["choices"]).map(String);
      this.scenario.replaceChildren(...choices.map((name) => make("option", { value: name, selected: name === programme?.["playing"] }, name)));
      this.scenarios.hidden = false;
      this.tell(wished, null);
    } catch (error) {
      this.tell(wished, error);
    }
  }

  /** At this speed; `null`: at the one that it has. */
  private async goOn(wished: number | null): Promise<void> {
    try {
      this.confirmed = Number(expect(await this.context.robot.ask({ call: { path: SPEED, argument: wished } }), "called"));
      this.speed.hidden = false;
      this.tell(wished, null);
    } catch (error) {
      this.tell(wished, error);
    }
    this.showSpeed();
  }

  /** What became of a wish for the world; `null` is a question that nobody put. */
  private tell(wished: string | number | null, reason: unknown): void {
    if (wished === null) this.failures.asked(reason);
    else this.failures.did(reason);
  }

  /** Somebody else may have wished one that is not offered here: it stands behind those that are. */
  private showSpeed(): void {
    const at = SPEEDS.findIndex(([, known]) => known === this.confirmed);
    this.speed.options[SPEEDS.length]?.remove();
    if (at < 0) this.speed.append(make("option", {}, `${this.confirmed} ×`));
    this.speed.selectedIndex = at < 0 ? SPEEDS.length : at;
  }

  private roll(): void {
    const { truth } = this;
    if (truth?.ball == null) return;
    const [x, y] = [truth.robot.x - truth.ball[0], truth.robot.y - truth.ball[1]];
    const length = Math.max(Math.hypot(x, y), 1e-6);
    this.deed({ ball_velocity: [x / length, y / length] });
  }

  private grasp(event: PointerEvent): void {
    const { truth } = this;
    if (event.button !== 0) return this.chart.pan(event);
    const thing = truth === null ? null : this.under([event.offsetX, event.offsetY], truth);
    if (thing === null) return this.chart.pan(event);
    this.canvas.setPointerCapture(event.pointerId);
    const move = (next: PointerEvent): void => {
      if (next.pointerId !== event.pointerId) return;
      this.dragged = { thing, at: this.chart.toField([next.offsetX, next.offsetY]) };
      this.draw();
    };
    const end = (last: PointerEvent): void => {
      if (last.pointerId !== event.pointerId) return;
      this.canvas.removeEventListener("pointermove", move);
      for (const name of ENDS) this.canvas.removeEventListener(name, end);
      if (this.dragged !== null && last.type === "pointerup") this.put(this.dragged.thing, this.dragged.at);
      this.dragged = null;
      this.draw();
    };
    this.canvas.addEventListener("pointermove", move);
    for (const name of ENDS) this.canvas.addEventListener(name, end);
  }

  private under([x, y]: Point, { robot, ball }: Truth): Thing | null {
    const places: [Thing, Point | null][] = [["ball", ball], ["heading", outOf(robot, [0.4, 0])], ["robot", [robot.x, robot.y]]];
    const near = places.filter(([, at]) => {
      if (at === null) return false;
      const [left, top] = this.chart.toPixel(at);
      return Math.hypot(left - x, top - y) < REACH;
    });
    return near[0]?.[0] ?? null;
  }

  private put(thing: Thing, [x, y]: Point): void {
    const { truth } = this;
    if (truth === null) return;
    const { robot } = truth;
    if (thing === "ball") this.deed({ ball: [x, y] });
    else if (thing === "robot") this.deed({ kidnap: [x, y, robot.heading] });
    else this.deed({ kidnap: [robot.x, robot.y, Math.atan2(y - robot.y, x - robot.x)] });
  }

  private paint(): void {
    const context = this.chart.begin(RULES, true);
    const { truth, dragged } = this;
    if (context === null || truth === null) return;
    for (const other of truth.robots) this.chart.robot(context, other, COLORS[other.isOwn ? 5 : 4] as string, other.name, false);
    const robot = { ...truth.robot };
    if (dragged?.thing === "robot") [robot.x, robot.y] = dragged.at;
    if (dragged?.thing === "heading") robot.heading = Math.atan2(dragged.at[1] - robot.y, dragged.at[0] - robot.x);
    this.chart.robot(context, robot, COLORS[0] as string, "", false);
    this.chart.disc(context, outOf(robot, [0.4, 0]), 0.05, null, "#ffffff");
    const ball = dragged?.thing === "ball" ? dragged.at : truth.ball;
    if (ball !== null) this.chart.disc(context, ball, 0.05, COLORS[1] as string, "#ffffff");
    this.state.textContent = truth.about;
  }
}

export const simulator: PanelKind = {
  kind: "simulator",
  name: "Simulator",
  open: (context) => new Simulator(context),
  offered: (entries) => entries.some((entry) => entry.path === DISTURB),
};
