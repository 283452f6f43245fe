// Owns the list of panels and of layouts that the page offers: for every robot, and for those that play football.
import { ROBOTICS, ROBOTICS_PRESETS } from "../robotics/kinds";
import type { Entry } from "../protocol";
import { PRESETS, withOnly, type Preset } from "../store/layout";
import { cycles } from "./cycles";
import { graph } from "./graph";
import { image } from "./image";
import { logs } from "./logs";
import type { PanelKind } from "./panel";
import { parameters } from "./parameters";
import { plot } from "./plot";
import { procedures } from "./procedures";
import { replay } from "./replay";
import { timings } from "./timings";
import { value } from "./value";

export const KINDS: readonly PanelKind[] = [value, plot, image, parameters, timings, cycles, procedures, logs, graph, replay, ...ROBOTICS];

export interface Offered {
  kinds: readonly PanelKind[];
  presets: readonly Preset[];
}

/** What a robot with these paths has something to show for. */
export function offeredBy(entries: readonly Entry[]): Offered {
  const kinds = KINDS.filter((kind) => kind.offered === undefined || kind.offered(entries));
  const has = (needed: string): boolean => kinds.some((kind) => kind.kind === needed);
  const presets = [...PRESETS, ...ROBOTICS_PRESETS].filter((preset) => preset.needs.every(has));
  return { kinds, presets: presets.map((preset) => ({ ...preset, layout: () => withOnly(preset.layout(), has) })) };
}
