// Owns what the robot said about its paths: asked for level by level, or whole for a search.
import { expect } from "../connection/socket";
import type { Ask, Entry, Good } from "../protocol";

/** Deeper than paths of a robot go; the robot says so where its limit is lower. */
const WHOLE = 32;

export class Paths {
  private readonly levels = new Map<string, Promise<readonly Entry[]>>();

  constructor(private readonly ask: (ask: Ask) => Promise<Good>) {}

  /** Another robot may have others. */
  forget(): void {
    this.levels.clear();
  }

  /** What lies directly below a path; empty: the root. */
  below(path: string): Promise<readonly Entry[]> {
    return this.once(path, 1);
  }

  /** Everything below a path. */
  everything(path = ""): Promise<readonly Entry[]> {
    return this.once(path, WHOLE);
  }

  /** The one entry of this path. */
  async find(path: string): Promise<Entry | undefined> {
    const end = path.lastIndexOf(".");
    const siblings = await this.below(end < 0 ? "" : path.slice(0, end));
    return siblings.find((entry) => entry.path === path);
  }

  private once(path: string, depth: number): Promise<readonly Entry[]> {
    const key = `${depth} ${path}`;
    let level = this.levels.get(key);
    if (level === undefined) {
      level = this.ask({ paths: { below: path, depth } }).then((good) => expect(good, "paths"));
      this.levels.set(key, level);
      // An answer that did not come may come later.
      level.catch(() => this.levels.delete(key));
    }
    return level;
  }
}

/** The last name of a path. */
export function nameOf(path: string): string {
  return path.slice(path.lastIndexOf(".") + 1);
}

/** Whether values of this type can be drawn as a curve. */
export function isNumber(entry: Entry): boolean {
  return entry.has_children === false && /^(Option<)?(f32|f64|bool|[iu](8|16|32|64|128|size))>?$/.test(entry.type ?? "");
}

/** Whether values of this type are pictures. */
export function isImage(entry: Entry): boolean {
  return entry.image != null;
}
