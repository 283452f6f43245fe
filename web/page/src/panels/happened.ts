// Owns which marks stand on the time of a recording: what happened to cycles, where, and in which words.

const WORDS = {
  missing: "cycles are missing",
  unfinished: "the cycle failed or was abandoned",
  restarted: "the first cycle after a restart",
  parameters: "the first cycle with changed parameters",
};

type What = keyof typeof WORDS;

/** As the replay tells it; times in seconds of the robot's clock. */
export interface Happened {
  instance: string;
  from: number;
  to: number;
  what: What;
}

export interface Mark {
  what: What;
  about: string;
  /** Where it leads. */
  time: number;
  /** On the axis, in percent of its length. */
  left: number;
  width: number;
}

/** Instances to which something happened, in the order in which it did, each with its marks. */
export function lanesOf(events: readonly Happened[], begins: number, ends: number): { instance: string; marks: Mark[] }[] {
  const length = Math.max(ends - begins, 1e-9);
  const instances = [...new Set(events.map(({ instance }) => instance))];
  return instances.map((instance) => {
    const own = events.filter((event) => event.instance === instance);
    return { instance, marks: own.map(({ from, to, what }) => ({ what, about: `${instance}: ${WORDS[what] ?? what}, ${spanOf(from, to)}`, time: from, left: (100 * (from - begins)) / length, width: (100 * (to - from)) / length })) };
  });
}

/** What the key under the marks explains: kinds that there are. */
export function kindsOf(events: readonly Happened[]): string[] {
  return Object.keys(WORDS).filter((kind) => events.some(({ what }) => what === kind));
}

function spanOf(from: number, to: number): string {
  return `${from.toFixed(3)} s${to > from ? ` to ${to.toFixed(3)} s` : ""}`;
}
