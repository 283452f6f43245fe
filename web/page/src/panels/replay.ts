// A panel that moves the time of a recording which a program shows in place of a robot: play, step, backwards, any speed.
import { expect } from "../connection/socket";
import type { Json, Welcome } from "../protocol";
import { isSameRun } from "../store/run";
import { button, make, select } from "../view/dom";
import { Failures } from "../view/failures";
import { plural } from "../view/format";
import { renew } from "../view/renew";
import { kindsOf, lanesOf, type Happened } from "./happened";
import { textSetting, type Context, type Panel, type PanelKind } from "./panel";

const TIMELINE = "Replay.procedures.timeline";
const PERIOD_MILLISECONDS = 250;
const SPEEDS = ["-4 ×", "-1 ×", "-0.25 ×", "0.1 ×", "0.25 ×", "0.5 ×", "1 ×", "2 ×", "4 ×", "16 ×"];
const EVERY = "all instances";

/** What the procedure is asked. */
type Move = { [key: string]: Json };

interface Place {
  time: number;
  begins: number;
  ends: number;
  is_playing: boolean;
  speed: number;
  instances: { instance: string; cycle: number | null; frames: number; missing: number }[];
  events?: Happened[];
}

class Replay implements Panel {
  readonly content: HTMLElement;
  private readonly slider = make("input", { type: "range", min: 0, max: 1, step: 0.001, value: 0, "aria-label": "time of the recording" });
  private readonly marks = make("div", { class: "lanes-of-events" });
  private readonly state = make("output", { class: "muted" });
  private readonly failures = new Failures();
  private readonly table = make("tbody");
  private readonly play: HTMLButtonElement;
  private readonly speed: HTMLSelectElement;
  private readonly whose: HTMLSelectElement;
  private readonly cycle = make("input", { type: "text", inputmode: "numeric", placeholder: "cycle", "aria-label": "go to this cycle of the instance" });
  private readonly timer: number;
  private readonly stop: () => void;
  private place: Place | null = null;
  /** Whose cycles are stepped, if the recording has them. */
  private chosen: string;
  /** Whose cycles may be stepped. */
  private offered: readonly string[] = [];
  private isDragged = false;
  private isAsked = false;
  /** Of the recording that is shown. */
  private areEventsKnown = false;
  /** Whose events they are: a run has one recording. */
  private known: Welcome | null = null;

  constructor(private readonly context: Context) {
    this.play = button("Pause", "play or pause (space)", () => void this.ask({ play: !(this.place?.is_playing ?? false) }), "deed");
    this.speed = select(SPEEDS, "1 ×", "speed; negative: backwards", (speed) => void this.ask({ speed: Number.parseFloat(speed), play: true }));
    this.chosen = textSetting(context.settings, "instance", EVERY);
    this.whose = select([...new Set([EVERY, this.chosen])], this.chosen, "whose cycles are stepped", (instance) => {
      this.chosen = instance;
      context.save({ instance });
    });
    const step = (text: string, about: string, by: number): HTMLButtonElement => button(text, about, () => this.step(by));
    this.content = make(
      "div",
      { class: "scroll replay", tabindex: "0" },
      make(
        "div",
        { class: "bar" },
        button("|◀", "to the begin", () => void this.ask({ time: this.place?.begins ?? 0 })),
        step("◀", "one cycle back (left)", -1),
        this.play,
        step("▶", "one cycle on (right)", 1),
        button("▶|", "to the end", () => void this.ask({ time: this.place?.ends ?? 0 })),
        this.speed,
        this.whose,
        this.cycle,
        this.state,
      ),
      this.failures.element,
      make("div", { class: "time-axis" }, this.slider, this.marks),
      make("table", { class: "timings" }, make("thead", {}, make("tr", {}, ...["instance", "cycle", "recorded", "missing"].map((text) => make("th", { scope: "col" }, text)))), this.table),
      make("p", { class: "muted" }, "To compare with a second run: save its curves with CSV in a plot, and open them with Compare in a plot of this one."),
    );
    this.slider.addEventListener("input", () => {
      this.isDragged = true;
      void this.ask({ time: Number(this.slider.value) });
    });
    this.slider.addEventListener("change", () => (this.isDragged = false));
    this.cycle.addEventListener("change", () => this.jump(this.cycle.value.trim()));
    this.content.addEventListener("keydown", (event) => this.key(event));
    this.timer = window.setInterval(() => void this.look(), PERIOD_MILLISECONDS);
    const stops = [
      context.robot.state.watch(() => {
        if (isSameRun(this.known, context.robot.welcome.value) !== true) this.areEventsKnown = false;
        void this.look();
      }),
      context.robot.moment.changed((moment) => {
        if (moment !== null) void this.ask({ instance: moment.instance, cycle: moment.cycle, play: false });
      }),
    ];
    this.stop = () => stops.forEach((stop) => stop());
  }

  close(): void {
    window.clearInterval(this.timer);
    this.stop();
  }

  private instance(): string | undefined {
    return this.whose.value === EVERY ? undefined : this.whose.value;
  }

  private step(by: number): void {
    const instance = this.instance();
    void this.ask({ step: by, ...(instance === undefined ? {} : { instance }) });
  }

  /** To a cycle as somebody typed it. */
  private jump(text: string): void {
    if (text === "") return this.failures.did(null);
    if (!/^\d+$/.test(text)) return this.failures.did(`\`${text}\` is no number of a cycle`);
    void this.ask({ cycle: Number(text), instance: this.instance() ?? this.place?.instances.at(-1)?.instance ?? "" });
  }

  private key(event: KeyboardEvent): void {
    if (event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement || event.target instanceof HTMLButtonElement) return;
    if (event.key === " ") this.play.click();
    else if (event.key === "ArrowLeft") this.step(-1);
    else if (event.key === "ArrowRight") this.step(1);
    else return;
    event.preventDefault();
  }

  /** Moves the time, as somebody wants it. */
  private async ask(move: Move): Promise<void> {
    await this.call(move, (reason) => this.failures.did(reason));
  }

  /** Asks where the time is, unless that is being told. */
  private async look(): Promise<void> {
    if (this.context.robot.state.value !== "open" || this.isAsked || document.hidden) return;
    await this.call(this.areEventsKnown ? {} : { events: true }, (reason) => this.failures.asked(reason));
  }

  private async call(argument: Move, told: (reason: unknown) => void): Promise<void> {
    this.isAsked = true;
    try {
      this.show(expect(await this.context.robot.ask({ call: { path: TIMELINE, argument } }), "called") as unknown as Place);
      told(null);
    } catch (error) {
      told(error);
    }
    this.isAsked = false;
  }

  private show(place: Place): void {
    this.place = place;
    this.play.textContent = place.is_playing ? "Pause" : "Play";
    Object.assign(this.slider, { min: String(place.begins), max: String(place.ends) });
    if (!this.isDragged) this.slider.value = String(place.time);
    const direction = place.speed < 0 ? "backwards" : "";
    this.state.textContent = `${place.time.toFixed(3)} s of ${place.begins.toFixed(1)} … ${place.ends.toFixed(1)} s ${direction}`;
    const speed = SPEEDS.find((text) => Number.parseFloat(text) === place.speed);
    if (speed !== undefined && document.activeElement !== this.speed) this.speed.value = speed;
    this.offer(place.instances.map(({ instance }) => instance));
    renew(
      this.table,
      place.instances.map(({ instance, cycle, frames, missing }) =>
        make("tr", { class: missing > 0 ? "bad" : "", "data-key": instance }, make("td", {}, instance), ...[cycle ?? "–", frames, missing].map((text) => make("td", {}, String(text)))),
      ),
    );
    if (place.events === undefined) return;
    this.areEventsKnown = true;
    this.known = this.context.robot.welcome.value;
    this.drawEvents(place.events, place);
  }

  /** Another recording has others. */
  private offer(instances: readonly string[]): void {
    const names = [EVERY, ...instances];
    if (names.join() === this.offered.join()) return;
    this.offered = names;
    // Also one that is not offered any more comes back when its recording does.
    const chosen = names.includes(this.chosen) ? this.chosen : EVERY;
    this.whose.replaceChildren(...names.map((name) => make("option", { value: name, selected: name === chosen }, name)));
  }

  /** A line for each instance to which something happened; what it was is told by words, too. */
  private drawEvents(events: readonly Happened[], { begins, ends }: Place): void {
    const lanes = lanesOf(events, begins, ends);
    this.marks.replaceChildren(
      ...lanes.map(({ instance, marks }) => {
        const buttons = marks.map(({ what, about, time, left, width }) => {
          const mark = make("button", { type: "button", class: `event ${what}`, title: about, "aria-label": about, click: () => void this.ask({ time, play: false }) });
          mark.style.left = `${left}%`;
          mark.style.width = `max(4px, ${width}%)`;
          return mark;
        });
        return make("div", { class: "event-lane" }, make("span", { class: "muted" }, `${instance}: ${plural(marks.length, "event")}`), make("div", { class: "event-marks" }, ...buttons));
      }),
    );
    const kinds = kindsOf(events);
    if (kinds.length > 0) this.marks.append(make("p", { class: "event-key muted" }, ...kinds.map((kind) => make("span", {}, make("i", { class: `event ${kind}` }), ` ${kind}`))));
    if (lanes.length === 0) this.marks.append(make("p", { class: "muted" }, "no cycle is missing, unfinished, or the first after a restart or with changed parameters"));
  }
}

export const replay: PanelKind = {
  kind: "replay",
  name: "Replay",
  open: (context) => new Replay(context),
  offered: (entries) => entries.some((entry) => entry.path === TIMELINE),
};
