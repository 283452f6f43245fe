// Owns which panels there are and where: kept by the browser, written into and read from a file.
import type { Json } from "../protocol";
import { Signal, type Readable } from "./signal";

export type Settings = Record<string, Json>;

export interface PanelPlace {
  /** Unique on this page. */
  id: string;
  kind: string;
  settings: Settings;
  /** Share of the column's height. */
  size: number;
  /** The address of the robot that it shows; absent: the one that served the page. */
  robot?: string;
}

export interface Column {
  panels: PanelPlace[];
  /** Share of the page's width. */
  size: number;
}

export interface Layout {
  version: 1;
  columns: Column[];
}

/** Where a panel goes: before the panel at `row` of a column, or into a new column there (`row` null). */
export interface Spot {
  column: number;
  row: number | null;
}

const KEY = "layout";

let nextId = 1;

export function place(kind: string, settings: Settings = {}, size = 1, robot?: string): PanelPlace {
  return { id: `panel-${nextId++}`, kind, settings, size, ...(robot === undefined ? {} : { robot }) };
}

/** Columns from left to right, each with its share of the width before its panels. */
export function layoutOf(...columns: readonly (readonly [number, ...PanelPlace[]])[]): Layout {
  return { version: 1, columns: columns.map(([size, ...panels]) => ({ size, panels })) };
}

/** Without panels that have nothing to show. */
export function withOnly(layout: Layout, has: (kind: string) => boolean): Layout {
  const columns = layout.columns.map((column) => ({ ...column, panels: column.panels.filter((panel) => has(panel.kind)) }));
  return { ...layout, columns: columns.filter((column) => column.panels.length > 0) };
}

/** What to begin with. */
export interface Preset {
  name: string;
  /** Kinds of panels without which it makes no sense. */
  needs: readonly string[];
  layout(): Layout;
}

/** Made for any robot. */
export const PRESETS: readonly Preset[] = [
  {
    name: "Overview",
    needs: [],
    layout: () => layoutOf([3, place("timings", {}, 3), place("logs", {}, 2)], [2, place("parameters")]),
  },
  {
    name: "Tuning",
    needs: [],
    layout: () => layoutOf([3, place("plot"), place("plot")], [2, place("parameters", {}, 2), place("procedures")]),
  },
  {
    name: "Graph",
    needs: [],
    layout: () => layoutOf([3, place("graph")], [2, place("cycles"), place("timings")]),
  },
  {
    name: "Replay",
    needs: ["replay"],
    layout: () => layoutOf([3, place("replay", {}, 2), place("plot", {}, 3)], [2, place("value"), place("logs")]),
  },
];

export class Arrangement {
  private readonly current: Signal<Layout>;
  /** What a whole other layout took the place of; null: none did. */
  private readonly replaced = new Signal<Layout | null>(null);

  constructor() {
    this.current = new Signal(read(localStorage.getItem(KEY)) ?? start());
  }

  get layout(): Readable<Layout> {
    return this.current;
  }

  get before(): Readable<Layout | null> {
    return this.replaced;
  }

  /** A preset or a file in place of what somebody has arranged, who may want that back. */
  replace(layout: Layout): void {
    this.replaced.set(this.current.value);
    this.use(layout);
  }

  /** The layout that was replaced last; from there the way back leads here. */
  back(): void {
    if (this.replaced.value !== null) this.replace(this.replaced.value);
  }

  /** Puts a new panel where there is most place. */
  add(kind: string, settings: Settings = {}): void {
    this.change((layout) => {
      const panel = place(kind, settings);
      const least = [...layout.columns].sort((one, other) => one.panels.length - other.panels.length)[0];
      if (least === undefined || (layout.columns.length < 2 && least.panels.length > 0)) layout.columns.push({ size: 1, panels: [panel] });
      else least.panels.push(panel);
    });
  }

  remove(id: string): void {
    this.change((layout) => void take(layout, id));
  }

  move(id: string, spot: Spot): void {
    this.change((layout) => {
      const column = layout.columns[spot.column];
      const before = spot.row === null ? undefined : column?.panels[spot.row];
      if (before?.id === id) return;
      const panel = take(layout, id);
      if (panel === undefined) return;
      if (spot.row === null || column === undefined) layout.columns.splice(spot.column, 0, { size: 1, panels: [panel] });
      else column.panels.splice(before === undefined ? column.panels.length : column.panels.indexOf(before), 0, panel);
    });
  }

  /** The panel shows another robot from now on: it begins anew. */
  assign(id: string, robot: string | undefined): void {
    this.change((layout) => {
      for (const column of layout.columns) {
        column.panels = column.panels.map((panel) => (panel.id === id ? place(panel.kind, panel.settings, panel.size, robot) : panel));
      }
    });
  }

  /** Another share for two neighbours; `row` null: of columns, else of panels. */
  resize(spot: Spot, sizes: [number, number]): void {
    this.change((layout) => {
      const list = spot.row === null ? layout.columns : (layout.columns[spot.column]?.panels ?? []);
      const at = spot.row ?? spot.column;
      const [one, other] = [list[at], list[at + 1]];
      if (one === undefined || other === undefined) return;
      [one.size, other.size] = sizes;
    });
  }

  /** Settings of a panel are kept and change nothing else: nobody is told. */
  configure(id: string, settings: Settings): void {
    for (const column of this.current.value.columns) {
      for (const panel of column.panels) if (panel.id === id) panel.settings = settings;
    }
    this.save();
  }

  use(layout: Layout): void {
    this.current.set(layout);
    this.save();
  }

  /** As a file for others. */
  text(): string {
    return `${JSON.stringify(this.current.value, null, 2)}\n`;
  }

  private change(deed: (layout: Layout) => void): void {
    const layout = this.current.value;
    deed(layout);
    layout.columns = layout.columns.filter((column) => column.panels.length > 0);
    this.use(layout);
  }

  private save(): void {
    try {
      localStorage.setItem(KEY, JSON.stringify(this.current.value));
    } catch (error) {
      console.warn("the layout is not kept:", error);
    }
  }
}

/** A layout as a file or the browser has it; null where it is none. */
export function read(text: string | null): Layout | null {
  let found: unknown;
  try {
    found = JSON.parse(text ?? "null");
  } catch {
    return null;
  }
  if (!isRecord(found) || found["version"] !== 1 || !Array.isArray(found["columns"])) return null;
  const columns: Column[] = [];
  for (const column of found["columns"] as unknown[]) {
    if (!isRecord(column) || !Array.isArray(column["panels"])) return null;
    const panels: PanelPlace[] = [];
    for (const panel of column["panels"] as unknown[]) {
      if (!isRecord(panel) || typeof panel["kind"] !== "string" || !isRecord(panel["settings"])) return null;
      const robot = typeof panel["robot"] === "string" ? panel["robot"] : undefined;
      panels.push(place(panel["kind"], panel["settings"] as Settings, share(panel["size"]), robot));
    }
    if (panels.length > 0) columns.push({ size: share(column["size"]), panels });
  }
  return { version: 1, columns };
}

function start(): Layout {
  return (PRESETS[0] as Preset).layout();
}

function take(layout: Layout, id: string): PanelPlace | undefined {
  for (const column of layout.columns) {
    const at = column.panels.findIndex((panel) => panel.id === id);
    if (at >= 0) return column.panels.splice(at, 1)[0];
  }
  return undefined;
}

function share(size: unknown): number {
  return typeof size === "number" && size > 0 && size < 100 ? size : 1;
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}
