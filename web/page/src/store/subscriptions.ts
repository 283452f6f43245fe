// Owns what is subscribed: once per path, rate and encoding however many panels watch it, and again after a reconnect.
import { decode, type Decoded, type Described, type Frame } from "../connection/binary";
import { expect, type Socket } from "../connection/socket";
import type { Encoding, Lost, Update } from "../protocol";

/** A value of one cycle. */
export interface Sample {
  cycle: number;
  /** In nanoseconds of the robot's clock. */
  time: number;
  /** Bytes: a JPEG file. */
  value: Decoded;
  /** Whether a client has put it in place of what the node wrote: only updates in JSON say so. */
  injected?: boolean;
}

export interface Watcher {
  sample(sample: Sample): void;
  /** The robot does not give this value, and says why; null: it does (again). */
  refused?(reason: string | null): void;
  /** Updates that did not come through. */
  lost?(updates: number): void;
}

export interface Wish {
  path: string;
  /** At most so many per second; absent: every cycle. */
  rate?: number;
  encoding?: Encoding;
}

interface Subscription {
  wish: Wish;
  watchers: Set<Watcher>;
  /** As the robot calls it; null while it does not know of it. */
  number: number | null;
  layout: Described | null;
  latest: Sample | null;
  refusal: string | null;
}

export class Subscriptions {
  private readonly byKey = new Map<string, Subscription>();
  private readonly byNumber = new Map<number, Subscription>();

  /** How many connections there were: an answer of one that is over names nothing on its successor. */
  private connection = 0;

  constructor(private readonly socket: () => Socket | null) {}

  /** Values from now on, the newest first if there is one already, until what it returns is called. */
  watch(wish: Wish, watcher: Watcher): () => void {
    const key = JSON.stringify([wish.path, wish.rate ?? null, wish.encoding ?? "json"]);
    let subscription = this.byKey.get(key);
    if (subscription === undefined) {
      subscription = { wish, watchers: new Set(), number: null, layout: null, latest: null, refusal: null };
      this.byKey.set(key, subscription);
      void this.subscribe(subscription);
    }
    const found = subscription;
    found.watchers.add(watcher);
    if (found.latest !== null) watcher.sample(found.latest);
    if (found.refusal !== null) watcher.refused?.(found.refusal);
    return () => {
      found.watchers.delete(watcher);
      if (found.watchers.size > 0 || this.byKey.get(key) !== found) return;
      this.byKey.delete(key);
      this.unsubscribe(found);
    };
  }

  /** A new connection knows of nothing. */
  renew(): void {
    this.connection++;
    this.byNumber.clear();
    for (const subscription of this.byKey.values()) {
      subscription.number = null;
      // Of a run that may be over: whoever watches later waits for the next one.
      subscription.latest = null;
      void this.subscribe(subscription);
    }
  }

  update(update: Update): void {
    const subscription = this.byNumber.get(update.subscription);
    // One that does not say its value says nothing.
    if (subscription !== undefined && update.value !== undefined) give(subscription, update);
  }

  frame(frame: Frame): void {
    const subscription = this.byNumber.get(frame.subscription);
    if (subscription === undefined) return;
    const { cycle, time, bytes } = frame;
    try {
      give(subscription, { cycle, time, value: valueOf(subscription, bytes) });
    } catch (error) {
      refuse(subscription, String(error));
    }
  }

  lost(lost: Lost): void {
    const subscription = typeof lost.subscription === "number" ? this.byNumber.get(lost.subscription) : undefined;
    for (const watcher of [...(subscription?.watchers ?? [])]) watcher.lost?.(lost.updates);
  }

  private async subscribe(subscription: Subscription): Promise<void> {
    const socket = this.socket();
    if (socket === null) return;
    const { connection } = this;
    const { path, rate, encoding } = subscription.wish;
    try {
      const good = await socket.ask({ subscribe: { path, ...(rate === undefined ? {} : { rate }), encoding: encoding ?? "json" } });
      const subscribed = expect(good, "subscribed");
      if (connection !== this.connection) return;
      subscription.number = subscribed.subscription;
      subscription.layout = encoding === "binary" ? ((subscribed.layout ?? null) as unknown as Described | null) : null;
      this.byNumber.set(subscribed.subscription, subscription);
      refuse(subscription, null);
      if (subscription.watchers.size === 0) this.unsubscribe(subscription);
    } catch (error) {
      if (connection === this.connection && socket === this.socket()) refuse(subscription, error instanceof Error ? error.message : String(error));
    }
  }

  private unsubscribe(subscription: Subscription): void {
    if (subscription.number === null) return;
    this.byNumber.delete(subscription.number);
    // Where the connection is gone, so is the subscription.
    this.socket()?.ask({ unsubscribe: { subscription: subscription.number } }).catch(() => undefined);
    subscription.number = null;
  }
}

/** Null where the part is not there in this cycle: such a frame ends behind its header. */
function valueOf({ layout }: Subscription, bytes: Uint8Array): Decoded {
  if (bytes.length === 0) return null;
  return layout === null ? bytes : decode(layout, bytes);
}

function give(subscription: Subscription, { cycle, time, value, injected }: Sample): void {
  subscription.latest = { cycle, time, value, ...(injected === true ? { injected } : {}) };
  // What could not be read before may be good again.
  if (subscription.refusal !== null) refuse(subscription, null);
  for (const watcher of [...subscription.watchers]) watcher.sample(subscription.latest);
}

function refuse(subscription: Subscription, reason: string | null): void {
  subscription.refusal = reason;
  for (const watcher of [...subscription.watchers]) watcher.refused?.(reason);
}
