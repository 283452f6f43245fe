// Owns the list of panels that the page offers.
import { graph } from "./graph";
import { image } from "./image";
import { logs } from "./logs";
import type { PanelKind } from "./panel";
import { parameters } from "./parameters";
import { plot } from "./plot";
import { procedures } from "./procedures";
import { timings } from "./timings";
import { value } from "./value";

export const KINDS: readonly PanelKind[] = [value, plot, image, parameters, timings, procedures, logs, graph];
