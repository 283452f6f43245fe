// A robot with parameters that is only played: it answers a write when the test says so.
import { load } from "./load.mjs";

const { Refused, Unheard, Tuning, isSame, isWithin, part } = await load("store/tuning.ts", "connection/socket.ts", "store/parts.ts");
const { shapeOf } = await load("panels/parameter_text.ts");

export { Refused, Unheard };

/** Sets the part at a path, and makes what it is in. */
function put(values, path, value) {
  const names = path.split(".");
  const last = names.pop();
  names.reduce((within, name) => (within[name] ??= {}), values)[last] = value;
}

export const settled = () => new Promise((resolve) => setTimeout(resolve, 0));

/** A robot with these parameters, by path, as its files say them, and what was asked of it. */
export class Played {
  welcome = { value: {} };
  paths = { everything: async () => [] };
  version = 1;
  writes = [];
  /** Which version brought a value that is not as in the files, by path. */
  versions = {};
  values = {};

  constructor(values) {
    for (const [path, value] of Object.entries(values)) put(this.values, path, value);
    this.stored = structuredClone(this.values);
  }

  async ask(ask) {
    if ("parameters" in ask) {
      const said = { parameters: { value: structuredClone(this.values), version: this.version, leaves: this.leaves("", this.values) } };
      await this.slow;
      return said;
    }
    if ("unstored" in ask) return { unstored: { version: this.version, changes: [], layers: [], creation_only: [] } };
    if ("store" in ask) {
      this.stored = structuredClone(this.values);
      this.forget();
      return { stored: { file: "robot.toml", paths: [], warnings: [] } };
    }
    if ("reload" in ask) {
      this.version++;
      this.values = structuredClone(this.stored);
      this.forget();
      return { written: { version: this.version } };
    }
    return new Promise((resolve, reject) => this.writes.push({ changes: ask.write.changes, take: () => resolve(this.take(ask.write.changes)), refuse: reject }));
  }

  /** Everything but an object that has something in it. */
  leaves(path, value) {
    const isObject = typeof value === "object" && value !== null && !Array.isArray(value) && Object.keys(value).length > 0;
    if (isObject) return Object.entries(value).flatMap(([name, part]) => this.leaves(path === "" ? name : `${path}.${name}`, part));
    const changed = Object.keys(this.versions).find((one) => isWithin(one, path) || isWithin(path, one));
    return [{ path, provenance: changed === undefined ? { from: "file", file: "default.toml", line: 1 } : { from: "live", version: this.versions[changed] } }];
  }

  take(changes) {
    this.version++;
    for (const { path, value } of changes) {
      put(this.values, path, this.held(value));
      for (const known of Object.keys(this.versions)) if (isWithin(path, known)) delete this.versions[known];
      this.versions[Object.keys(this.versions).find((known) => isWithin(known, path)) ?? path] = this.version;
    }
    this.forget();
    return { written: { version: this.version } };
  }

  /** A change that is again as the files say is none. */
  forget() {
    for (const path of Object.keys(this.versions)) if (isSame(part(this.values, path), part(this.stored, path))) delete this.versions[path];
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
