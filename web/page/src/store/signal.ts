// Owns the one kind of state that panels watch.

export interface Readable<T> {
  readonly value: T;
  /** Calls now and at every change, until what it returns is called. */
  watch(listener: (value: T) => void): () => void;
}

export class Signal<T> implements Readable<T> {
  private readonly listeners = new Set<(value: T) => void>();

  constructor(private current: T) {}

  get value(): T {
    return this.current;
  }

  set(value: T): void {
    this.current = value;
    // One of them may stop others: those are not told any more.
    for (const listener of [...this.listeners]) if (this.listeners.has(listener)) listener(value);
  }

  watch(listener: (value: T) => void): () => void {
    const stop = this.changed(listener);
    listener(this.current);
    return stop;
  }

  /** Calls at every change from now on: for what is over once it was heard. */
  changed(listener: (value: T) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}
