// A panel with a camera's image and what the nodes found in it, drawn over it: of the same cycle, where that is there.
import { ImagePanel } from "../panels/image";
import type { Context, PanelKind } from "../panels/panel";
import { COLORS } from "../panels/series";
import type { Entry } from "../protocol";
import type { Settings } from "../store/layout";
import type { Sample } from "../store/subscriptions";
import { make, sharp } from "../view/dom";
import { fields, list, number, pose3, rotate, point, type Point } from "./geometry";
import { Values } from "./values";
import type { Decoded } from "../connection/binary";

const [, AMBER, GREEN, PINK, RED, SKY] = COLORS as [string, string, string, string, string, string];
/** Outputs of the image's instance, by the overlay that draws them. */
const OUTPUTS: Record<string, readonly string[]> = {
  segments: ["main_outputs.image_segments"],
  lines: ["additional_outputs.image_lines", "additional_outputs.image_circle", "main_outputs.corners"],
  balls: ["additional_outputs.ball_candidates", "main_outputs.balls"],
  horizon: ["main_outputs.camera_matrix"],
  border: ["main_outputs.field_border"],
  limbs: ["main_outputs.limb_mask"],
  robots: ["main_outputs.obstacles"],
};
const OVERLAYS = Object.keys(OUTPUTS);
/** Much to send and to look at: shown when somebody asks. */
const QUIET = new Set(["segments"]);

class Camera extends ImagePanel {
  private readonly over = make("canvas", { class: "over", "aria-hidden": "true" });
  private readonly shown: Set<string>;
  private readonly values: Values;
  private readonly layers = make("div", { class: "bar layers" });
  /** Whose image is shown. */
  private cycle: Pick<Sample, "cycle" | "time"> = { cycle: 0, time: 0 };
  private entries: readonly Entry[] = [];
  private readonly stopFinding: () => void;

  constructor(context: Context) {
    super(context);
    const chosen = context.settings["overlays"];
    this.shown = new Set(Array.isArray(chosen) ? chosen.filter((one): one is string => typeof one === "string") : OVERLAYS.filter((one) => !QUIET.has(one)));
    this.values = new Values(context.robot, () => undefined);
    this.stage.append(this.over);
    this.stage.before(this.layers);
    for (const overlay of OVERLAYS) this.layers.append(this.box(overlay));
    this.save();
    this.stopFinding = context.robot.welcome.watch((welcome) => {
      if (welcome !== null) void this.find();
    });
  }

  override close(): void {
    super.close();
    this.stopFinding();
    this.values.close();
  }

  /** Called by the panel below whenever another image is asked for, also before this one is made. */
  protected override moved(): void {
    if (this.values !== undefined) this.watchAll();
  }

  protected override kept(): Settings {
    return this.shown === undefined ? {} : { overlays: [...this.shown] };
  }

  private box(overlay: string): HTMLElement {
    const box = make("input", { type: "checkbox", checked: this.shown.has(overlay) });
    box.addEventListener("change", () => {
      if (box.checked) this.shown.add(overlay);
      else this.shown.delete(overlay);
      this.save();
      this.watchAll();
    });
    return make("label", { class: "layer" }, box, overlay);
  }

  private async find(): Promise<void> {
    this.entries = await this.context.robot.paths.everything().catch(() => []);
    if (this.path === "") {
      const first = this.entries.find((entry) => entry.image != null);
      if (first !== undefined) this.accept(first.path);
    }
    this.watchAll();
  }

  private watchAll(): void {
    const instance = this.path.split(".")[0] ?? "";
    for (const overlay of OVERLAYS) {
      for (const output of OUTPUTS[overlay] ?? []) {
        const path = `${instance}.${output}`;
        const isThere = this.entries.some((entry) => entry.path === path);
        this.values.set(output, this.shown.has(overlay) && isThere ? path : null, this.rate);
      }
    }
  }

  protected override drawn(sample: Sample): void {
    this.cycle = { cycle: sample.cycle, time: sample.time };
    const { width, height } = this.canvas;
    // As fine as the screen, however few pixels the image has.
    const context = sharp(this.over);
    if (context === null) return;
    const { clientWidth, clientHeight } = this.over;
    context.clearRect(0, 0, clientWidth, clientHeight);
    context.save();
    // Where `object-fit: contain` has the image.
    const scale = Math.min(clientWidth / width, clientHeight / height);
    context.translate((clientWidth - scale * width) / 2, (clientHeight - scale * height) / 2);
    context.scale(scale, scale);
    context.beginPath();
    context.rect(0, 0, width, height);
    context.clip();
    this.drawShown(context, width, height);
    context.restore();
  }

  private drawShown(context: CanvasRenderingContext2D, width: number, height: number): void {
    context.lineWidth = 2;
    if (this.shown.has("segments")) this.drawSegments(context);
    if (this.shown.has("limbs")) this.drawLimbs(context, height);
    if (this.shown.has("horizon")) this.drawHorizon(context, width);
    if (this.shown.has("border")) this.drawBorder(context, width);
    if (this.shown.has("lines")) this.drawLines(context);
    if (this.shown.has("robots")) this.drawRobots(context);
    if (this.shown.has("balls")) this.drawBalls(context);
  }

  private value(output: string): Decoded | undefined {
    return this.values.of(output, this.cycle);
  }

  private drawSegments(context: CanvasRenderingContext2D): void {
    for (const value of list(fields(this.value("main_outputs.image_segments"))?.["segments"])) {
      const segment = fields(value);
      const [column, start, end] = ["column", "start", "end"].map((name) => number(segment?.[name]));
      if (column == null || start == null || end == null || segment?.["is_field"] === true) continue;
      line(context, [[column, start], [column, end]], `${PINK}b0`);
    }
  }

  private drawLimbs(context: CanvasRenderingContext2D, height: number): void {
    for (const limb of list(fields(this.value("main_outputs.limb_mask"))?.["limbs"])) {
      const corners = list(fields(limb)?.["corners"]).map(point).filter((one) => one !== null);
      const [first, last] = [corners[0], corners.at(-1)];
      if (first === undefined || last === undefined) continue;
      context.fillStyle = `${SKY}30`;
      trace(context, [[first[0], height], ...corners, [last[0], height]]);
      context.fill();
      line(context, corners, SKY);
    }
  }

  /** Where the ground would end if it had no end: pixels whose rays are level. */
  private drawHorizon(context: CanvasRenderingContext2D, width: number): void {
    const matrix = fields(this.value("main_outputs.camera_matrix"));
    const toCamera = pose3(matrix?.["ground_to_camera"]);
    const [focal, center] = [point(fields(matrix?.["intrinsics"])?.["focal"]), point(fields(matrix?.["intrinsics"])?.["center"])];
    if (toCamera === null || focal === null || center === null) return;
    const [x, y, z] = rotate(toCamera.rotation, [0, 0, 1]);
    if (Math.abs(y) < 1e-6) return;
    const row = (column: number): number => center[1] - (focal[1] * ((x * (column - center[0])) / focal[0] + z)) / y;
    context.setLineDash([8, 6]);
    line(context, [[0, row(0)], [width, row(width)]], "#ffffff");
    context.setLineDash([]);
  }

  private drawBorder(context: CanvasRenderingContext2D, width: number): void {
    for (const value of list(fields(this.value("main_outputs.field_border"))?.["lines"])) {
      const [left, slope] = [number(fields(value)?.["at_left"]), number(fields(value)?.["slope"])];
      if (left !== null && slope !== null) line(context, [[0, left], [width, left + slope * width]], GREEN);
    }
  }

  private drawLines(context: CanvasRenderingContext2D): void {
    for (const value of list(this.value("additional_outputs.image_lines"))) {
      const ends = list(value).map(point).filter((one) => one !== null);
      line(context, ends, "#000000");
      context.setLineDash([6, 4]);
      line(context, ends, SKY);
      context.setLineDash([]);
    }
    line(context, list(this.value("additional_outputs.image_circle")).map(point).filter((one) => one !== null), PINK);
    for (const value of list(this.value("main_outputs.corners"))) {
      const corner = fields(value);
      const center = point(corner?.["center"]);
      if (center !== null) label(context, center[0] + 6, center[1] - 6, String(corner?.["kind"] ?? "?"), PINK);
    }
  }

  private drawRobots(context: CanvasRenderingContext2D): void {
    for (const value of list(this.value("main_outputs.obstacles"))) {
      const foot = point(fields(value)?.["foot"]);
      if (foot === null) continue;
      const [x, y] = foot;
      line(context, [[x - 12, y], [x + 12, y]], RED);
      line(context, [[x, y], [x, y - 40]], RED);
      label(context, x + 6, y - 28, "obstacle", RED);
    }
  }

  private drawBalls(context: CanvasRenderingContext2D): void {
    for (const value of list(this.value("additional_outputs.ball_candidates"))) circle(context, value, `${AMBER}70`, 1);
    for (const value of list(this.value("main_outputs.balls"))) {
      const at = circle(context, value, AMBER, 3);
      if (at !== null) label(context, at[0] + 6, at[1] - 6, "ball", AMBER);
    }
  }
}

function trace(context: CanvasRenderingContext2D, points: readonly Point[]): void {
  context.beginPath();
  points.forEach(([x, y], at) => (at === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
}

function line(context: CanvasRenderingContext2D, points: readonly Point[], color: string): void {
  context.strokeStyle = color;
  trace(context, points);
  context.stroke();
}

function circle(context: CanvasRenderingContext2D, value: Decoded, color: string, width: number): Point | null {
  const candidate = fields(value);
  const [center, radius] = [point(candidate?.["center"]), number(candidate?.["radius"])];
  if (center === null || radius === null || radius < 0) return null;
  context.strokeStyle = color;
  context.lineWidth = width;
  context.beginPath();
  context.arc(...center, radius, 0, 2 * Math.PI);
  context.stroke();
  context.lineWidth = 2;
  return [center[0] + radius, center[1] - radius];
}

function label(context: CanvasRenderingContext2D, x: number, y: number, text: string, color: string): void {
  context.font = "600 14px system-ui, sans-serif";
  context.strokeStyle = "#000000b0";
  context.lineWidth = 3;
  context.strokeText(text, x, y);
  context.fillStyle = color;
  context.fillText(text, x, y);
  context.lineWidth = 2;
}

export const camera: PanelKind = {
  kind: "camera",
  name: "Camera",
  open: (context) => new Camera(context),
  offered: (entries) => entries.some((entry) => entry.type === "FieldBorder"),
};
