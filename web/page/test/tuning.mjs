// A robot with parameters that is only played: it answers a write when the test says so.
import { load } from "./load.mjs";

const { Refused, Tuning } = await load("store/tuning.ts", "connection/socket.ts");
const { shapeOf } = await load("panels/parameter_text.ts");

export { Refused };

export const settled = () => new Promise((resolve) => setTimeout(resolve, 0));

/** A robot with these parameters, and what was asked of it. */
class Played {
  welcome = { value: {} };
  paths = { everything: async () => [] };
  version = 1;
  writes = [];
  /** Which version brought a value, by path. */
  versions = {};

  constructor(values) {
    this.values = values;
  }

  async ask(ask) {
    if ("parameters" in ask) {
      const leaves = Object.keys(this.values).map((path) => ({ path, provenance: path in this.versions ? { from: "live", version: this.versions[path] } : { from: "nowhere" } }));
      const said = { parameters: { value: { ...this.values }, version: this.version, leaves } };
      await this.slow;
      return said;
    }
    if ("unstored" in ask) return { unstored: { version: this.version, changes: [], layers: [], creation_only: [] } };
    return new Promise((resolve, reject) => this.writes.push({ changes: ask.write.changes, take: () => resolve(this.take(ask.write.changes)), refuse: reject }));
  }

  take(changes) {
    this.version++;
    for (const { path, value } of changes) {
      this.values[path] = this.held(value);
      this.versions[path] = this.version;
    }
    return { written: { version: this.version } };
  }

  /** As the type of a parameter holds it. */
  held(value) {
    return value;
  }
}

export async function tuned(values) {
  const robot = new Played(values);
  const tuning = new Tuning(robot);
  await tuning.load();
  const find = (path) => tuning.tuned.value.parameters.find((one) => one.path === path);
  return {
    robot,
    tuning,
    find,
    type: (path, text) => tuning.note(find(path), shapeOf(find(path)).read(text)),
    value: (path) => find(path)?.value,
    pending: () => [...tuning.pending.value].map(([path, { text }]) => [path, text]),
  };
}
