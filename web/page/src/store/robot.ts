// Owns what the page knows of its robot: connection, paths, subscriptions, logs. Panels read it and ask through it.
import { expect, Refused, Socket, type State } from "../connection/socket";
import type { Ask, Good, Lost, Message, Welcome } from "../protocol";
import { Alignment } from "./clock";
import { Logs, type Line } from "./logs";
import { Paths } from "./paths";
import { isSameRun } from "./run";
import { Signal, type Readable } from "./signal";
import { Subscriptions } from "./subscriptions";

/** A cycle that somebody wants to look at in every panel. */
export interface Moment {
  /** In seconds of the robot's clock. */
  time: number;
  instance: string;
  cycle: number;
}

export class Robot {
  /** The newest cycle that somebody jumped to. A panel that is opened later goes nowhere. */
  readonly moment = new Signal<Moment | null>(null);
  readonly subscriptions = new Subscriptions(() => (this.isWelcome ? this.socket : null));
  readonly paths = new Paths((ask) => this.ask(ask));
  private readonly alignments = new WeakMap<Robot, Alignment>();
  private readonly socket: Socket;
  private readonly states = new Signal<State>("connecting");
  private readonly welcomes = new Signal<Welcome | null>(null);
  private readonly writes = new Signal(false);
  private readonly versions = new Signal(0);
  private readonly said = new Logs();
  private isWelcome = false;
  private areLogsWanted = false;

  /** `tokenKey`: where the browser keeps the token of this robot until its tab is closed. */
  constructor(
    address: string,
    private readonly tokenKey: string,
  ) {
    this.socket = new Socket(address, {
      state: (state) => this.enter(state),
      welcome: (welcome) => this.begin(welcome),
      message: (message) => this.hear(message),
      frame: (frame) => this.subscriptions.frame(frame),
    });
  }

  /** Nobody asks for it any more. */
  close(): void {
    this.socket.close();
  }

  get state(): Readable<State> {
    return this.states;
  }

  /** What the robot said of itself; stays while the connection is lost. */
  get welcome(): Readable<Welcome | null> {
    return this.welcomes;
  }

  get canWrite(): Readable<boolean> {
    return this.writes;
  }

  /** Changes whenever somebody changed parameters. */
  get parameters(): Readable<number> {
    return this.versions;
  }

  /** The newest messages, oldest first. */
  get logs(): Readable<readonly Line[]> {
    return this.said.lines;
  }

  /** Seconds from the times of another robot to those of this one; null: not known now. */
  shiftFrom(other: Robot): Readable<number | null> {
    const alignment = this.alignments.get(other) ?? new Alignment(this, other);
    this.alignments.set(other, alignment);
    return alignment;
  }

  ask(ask: Ask): Promise<Good> {
    return this.socket.ask(ask);
  }

  /** Proves that this page may write. */
  async authenticate(token: string): Promise<void> {
    expect(await this.ask({ authenticate: { token } }), "done");
    sessionStorage.setItem(this.tokenKey, token);
    this.writes.set(true);
  }

  /** From now on logs are kept here. */
  wantLogs(): void {
    if (this.areLogsWanted) return;
    this.areLogsWanted = true;
    const { value: welcome } = this.welcomes;
    if (this.isWelcome && welcome !== null) this.askForLogs(welcome);
  }

  private enter(state: State): void {
    if (state === "waiting") this.isWelcome = false;
    this.states.set(state);
  }

  private begin(welcome: Welcome): void {
    this.isWelcome = true;
    // A slow link has better things to carry than what the same program says once more.
    if (isSameRun(this.welcomes.value, welcome) !== true) this.paths.forget();
    // Before anybody hears of it and subscribes to more.
    this.subscriptions.renew();
    this.writes.set(welcome.can_write && !welcome.needs_token);
    this.welcomes.set(welcome);
    this.versions.set(this.versions.value + 1);
    if (this.areLogsWanted) this.askForLogs(welcome);
    const token = sessionStorage.getItem(this.tokenKey);
    if (welcome.needs_token && token !== null) {
      this.authenticate(token).catch((error: unknown) => {
        if (error instanceof Refused) sessionStorage.removeItem(this.tokenKey);
      });
    }
  }

  private askForLogs(welcome: Welcome): void {
    this.said.begin(welcome);
    this.ask({ logs: { level: "trace" } }).catch((error: unknown) => console.warn("no logs:", error));
  }

  private miss(lost: Lost): void {
    if (typeof lost.subscription === "number") this.subscriptions.lost(lost);
    else this.said.lost(lost.updates);
  }

  private hear(message: Message): void {
    if ("update" in message) this.subscriptions.update(message.update);
    else if ("lost" in message) this.miss(message.lost);
    else if ("log" in message && typeof message.log?.message === "string") this.said.add(message.log);
    else if ("parameters_changed" in message) this.versions.set(this.versions.value + 1);
  }
}
