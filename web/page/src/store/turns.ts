// Owns that deeds which need the end of the one before wait for it.

export class Turns {
  private last: Promise<unknown> = Promise.resolve();

  /** Does it once everything before it has ended, well or not. */
  take<T>(deed: () => Promise<T>): Promise<T> {
    const next = this.last.then(deed);
    this.last = next.catch(() => undefined);
    return next;
  }
}
