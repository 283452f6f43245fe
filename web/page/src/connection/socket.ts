// Owns the WebSocket: requests with their answers, messages of the robot, and coming back after it was lost.
import type { Ask, Failure, Good, Message, Welcome } from "../protocol";
import { readFrames, type Frame } from "./binary";
import { readMessages, writeJson } from "./exact";

/** `waiting`: there is no connection, and one is tried again and again. */
export type State = "connecting" | "open" | "waiting";

export interface Listener {
  state(state: State): void;
  /** Before anything else of a connection. */
  welcome(welcome: Welcome): void;
  message(message: Message): void;
  frame(frame: Frame): void;
}

/** What the robot refused, or what was in the way of an answer. */
export class Refused extends Error {
  constructor(readonly failure: Failure) {
    // The message says in one line what is wrong with each.
    const each = (failure.refusals ?? []).map((one) => (one.path === "" ? one.message : `${one.path}: ${one.message}`));
    super(each.length > 0 ? each.join("\n") : failure.message);
  }
}

/** The connection was lost before the answer came: what was asked for may have been done. */
export class Unheard extends Error {}

type Name<T> = T extends unknown ? keyof T : never;
type Content<T, N extends Name<T>> = Extract<T, Record<N, unknown>>[N];

/** The part of an answer that was expected. */
export function expect<N extends Name<Good>>(good: Good, name: N): Content<Good, N> {
  if (!(name in good)) throw new Error(`the robot answered something else than \`${name}\``);
  return (good as unknown as Record<N, Content<Good, N>>)[name];
}

interface Pending {
  resolve(good: Good): void;
  reject(error: Error): void;
}

/** Short enough that a robot that restarts is there again at once, long enough for a phone's battery. */
const RETRY_MILLISECONDS = 1000;

/** A robot that says nothing while it is looked at so often in a row is gone, also where its network does not say so. */
const SILENT_LOOKS = 3;
/** As often on a link that turned out to be slow: the robot itself gives up what is not taken within 20 s. */
const MOST_SILENT_LOOKS = 9;
/** A link that was never silent for longer than `SILENT_LOOKS` while it was looked at so often is quick again. */
const QUICK_LOOKS = 60;
const LOOK_MILLISECONDS = 2000;

export class Socket {
  private socket: WebSocket | null = null;
  private readonly pending = new Map<number, Pending>();
  private nextId = 1;
  /** Looks since the robot said something. */
  private silence = 0;
  /** So many are borne. */
  private patience = SILENT_LOOKS;
  /** Whether the robot has said something on this connection. */
  private isHeard = false;
  /** Whether the connection before was given up for its silence. */
  private wasSilent = false;
  /** Looks since more silence than usual. */
  private quick = 0;
  /** Another question would only lie behind the one that has no answer yet. */
  private isAsked = false;
  private readonly watching: number;
  private isClosed = false;

  constructor(
    private readonly address: string,
    private readonly listener: Listener,
  ) {
    this.watching = window.setInterval(() => this.watch(), LOOK_MILLISECONDS);
    this.connect();
  }

  /** For good. */
  close(): void {
    this.isClosed = true;
    window.clearInterval(this.watching);
    const socket = this.socket;
    if (socket !== null) this.lose();
    socket?.close();
  }

  /** Asks the robot; without a connection the answer is an error. */
  ask(ask: Ask): Promise<Good> {
    const socket = this.socket;
    if (socket === null || socket.readyState !== WebSocket.OPEN) {
      return Promise.reject(new Error("there is no connection to the robot"));
    }
    const id = this.nextId++;
    return new Promise((resolve, reject) => {
      this.pending.set(id, { resolve, reject });
      socket.send(writeJson({ id, ask }));
    });
  }

  private connect(): void {
    if (this.isClosed) return;
    this.listener.state("connecting");
    const socket = new WebSocket(this.address);
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event) => void this.hear(socket, event.data);
    socket.onclose = () => {
      if (this.socket === socket) this.lose();
    };
    this.socket = socket;
    this.silence = 0;
    this.isHeard = false;
    this.isAsked = false;
  }

  private lose(isSilent = false): void {
    this.socket = null;
    this.wasSilent = isSilent && this.isHeard;
    // Nobody answers: the link was none that is slow, and whoever is gone is to be missed soon.
    if (!this.isHeard) this.patience = SILENT_LOOKS;
    for (const pending of this.pending.values()) pending.reject(new Unheard("the connection to the robot was lost"));
    this.pending.clear();
    this.listener.state("waiting");
    window.setTimeout(() => this.connect(), RETRY_MILLISECONDS);
  }

  private watch(): void {
    const socket = this.socket;
    if (socket === null) return;
    this.quick = this.silence < SILENT_LOOKS ? this.quick + 1 : 0;
    if (this.quick >= QUICK_LOOKS) this.patience = SILENT_LOOKS;
    // Counted, not timed: browsers let hidden pages look at the clock once a minute.
    const isOpen = socket.readyState === WebSocket.OPEN;
    if (this.silence++ >= (isOpen ? this.patience : SILENT_LOOKS)) {
      // `onclose` may take minutes where the network is silent.
      this.lose(true);
      socket.close();
    } else if (isOpen && !this.isAsked) {
      this.isAsked = true;
      // Anything that is answered shows that the robot is there.
      const answered = (): void => {
        if (this.socket === socket) this.isAsked = false;
      };
      this.ask({ paths: { below: "parameters", depth: 0 } }).then(answered, answered);
    }
  }

  /** Of a connection that is over nothing is heard any more, also not the rest of a message: its successor says what is newer. */
  private async hear(socket: WebSocket, data: unknown): Promise<void> {
    if (this.socket !== socket) return;
    this.silence = 0;
    if (!this.isHeard) this.beginToHear();
    if (data instanceof ArrayBuffer) {
      for (const frame of readFrames(data)) {
        if (this.socket === socket) tolerate(() => this.listener.frame(frame));
      }
      return;
    }
    for (const message of parse(data)) {
      tolerate(() => this.take(message));
      // Whoever waited for an answer goes on before what came with it is heard: the first update of a subscription.
      await null;
      if (this.socket !== socket) return;
    }
  }

  /**
   * Who was silent and answers the first attempt was there: a large message was on its way, of which the browser does
   * not show the half. To ask for it again and again is worse than to see a loss late.
   */
  private beginToHear(): void {
    this.isHeard = true;
    if (this.wasSilent) this.patience = Math.min(this.patience + SILENT_LOOKS, MOST_SILENT_LOOKS);
    this.wasSilent = false;
  }

  private take(message: Message): void {
    if ("welcome" in message) {
      // A robot that does not know it sends each message alone.
      this.ask({ bundle: {} }).catch(() => undefined);
      this.listener.welcome(message.welcome);
      this.listener.state("open");
    } else if ("answer" in message) {
      this.answer(message);
    } else {
      this.listener.message(message);
    }
  }

  private answer({ answer }: Extract<Message, { answer: unknown }>): void {
    const pending = typeof answer.id === "number" ? this.pending.get(answer.id) : undefined;
    if (pending === undefined || typeof answer.id !== "number") return;
    this.pending.delete(answer.id);
    if ("ok" in answer) pending.resolve(answer.ok);
    else pending.reject(new Refused(answer.error));
  }
}

/** Whatever a robot says that nobody understands: what comes next may be good again. */
function tolerate(deed: () => void): void {
  try {
    deed();
  } catch (error) {
    console.warn("the robot sent a message that was not understood:", error);
  }
}

/** What is no message is left alone: a robot of a later version may say more. */
function parse(data: unknown): Message[] {
  if (typeof data !== "string") return [];
  try {
    return read(data).filter((message): message is Message => typeof message === "object" && message !== null);
  } catch {
    console.warn("the robot sent something that is not JSON");
    return [];
  }
}

function read(data: string): unknown[] {
  try {
    return readMessages(data);
  } catch (error) {
    if (error instanceof SyntaxError) throw error;
    // Nested too deeply for all digits: without them is better than whoever waits for an answer waiting for ever.
    const said: unknown = JSON.parse(data);
    return Array.isArray(said) ? said : [said];
  }
}
