// A panel with the body as its sensors feel it, in three dimensions, and what presses on its soles.
// Drawn by hand on a plain canvas: a body of lines needs no library.
import { button, eachFrame, make, sharp } from "../view/dom";
import type { Context, Panel, PanelKind } from "../panels/panel";
import { COLORS } from "../panels/series";
import { paletteOf } from "./chart";
import { fields, list, number, place3, pose3, quaternion, rotate, transform, type Fields, type Place3, type Pose3 } from "./geometry";
import { ofType, output, Values } from "./values";

const RATE = 30;
const SIDES = ["left", "right"] as const;
type Side = (typeof SIDES)[number];

/** Where limbs begin in the torso frame, m (Aldebaran's documentation of NAO V6). */
const HIP: Place3 = [0, 0.05, -0.085];
const SHOULDER: Place3 = [0, 0.098, 0.1];
/** Of a sole in its frame, m: toe, heel, half width. */
const SOLE = { front: 0.1, back: -0.04, half: 0.035 };
/** Where the four sensors of a sole lie in its frame, m: front left, front right, rear left, rear right. */
const SENSORS: readonly Place3[] = [[0.07, 0.03, 0], [0.07, -0.03, 0], [-0.03, 0.03, 0], [-0.03, -0.03, 0]];
/** So long is an arrow per N. */
const PER_NEWTON = 0.006;
/** Of sensors that count in kg (LoLA's): to N. */
const GRAVITY = 9.81;

interface Stroke {
  points: Place3[];
  color: string;
  width: number;
}

class PosePanel implements Panel {
  readonly content: HTMLElement;
  readonly tools: HTMLElement[];
  private readonly draw = eachFrame(() => this.paint());
  private readonly canvas = make("canvas", { class: "pose", role: "img", "aria-label": "body in three dimensions", tabindex: "0" });
  private readonly state = make("output", { class: "muted" });
  private readonly values: Values;
  private readonly stop: () => void;
  /** Where the eye is: around, and above, in rad; how near. */
  private view = { around: 0.6, above: 0.25, zoom: 1 };

  constructor(context: Context) {
    this.values = new Values(context.robot, this.draw);
    this.content = make("div", { class: "map" }, make("div", { class: "bar" }, this.state), this.canvas);
    const look = (around: number, above: number) => (): void => {
      this.view = { around, above, zoom: 1 };
      this.draw();
    };
    this.tools = [button("Front", "look at its face", look(0, 0.1)), button("Side", "look at its left side", look(Math.PI / 2, 0.1)), button("Oblique", "look from above", look(0.6, 0.25))];
    this.turnByHand();
    this.stop = context.robot.welcome.watch((welcome) => {
      if (welcome !== null) void this.find(context);
    });
  }

  close(): void {
    this.stop();
    this.values.close();
  }

  resized(): void {
    this.draw();
  }

  private turnByHand(): void {
    this.canvas.addEventListener("pointermove", (event) => {
      if (event.buttons === 0) return;
      this.turn(event.movementX / 150, event.movementY / 150);
    });
    this.canvas.addEventListener("pointerdown", (event) => this.canvas.setPointerCapture(event.pointerId));
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.view.zoom = Math.min(Math.max(this.view.zoom * Math.exp(-event.deltaY / 500), 0.4), 5);
      this.draw();
    }, { passive: false });
    this.canvas.addEventListener("keydown", (event) => {
      const turns: Record<string, [number, number]> = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
      const turn = turns[event.key];
      if (turn === undefined) return;
      event.preventDefault();
      this.turn(...turn);
    });
  }

  private turn(around: number, above: number): void {
    this.view.around -= around;
    this.view.above = Math.min(Math.max(this.view.above + above, -1.5), 1.5);
    this.draw();
  }

  private async find({ robot }: Context): Promise<void> {
    const entries = await robot.paths.everything().catch(() => []);
    const sensors = output(entries, "sensor_data", "SensorData")?.path;
    this.values.set("kinematics", output(entries, "robot_kinematics", "RobotKinematics")?.path ?? null, RATE);
    this.values.set("orientation", output(entries, "orientation", "Unit<Quaternion<f32>>")?.path ?? null, RATE);
    this.values.set("forces", sensors === undefined ? null : `${sensors}.force_sensitive_resistors`, RATE);
    this.values.set("mass", entries.find((entry) => /^[^.]+\.main_outputs\.center_of_mass$/.test(entry.path))?.path ?? null, RATE);
  }

  private paint(): void {
    const context = sharp(this.canvas);
    const body = fields(this.values.get("kinematics"));
    if (context === null || body === null) return;
    context.clearRect(0, 0, this.canvas.clientWidth, this.canvas.clientHeight);
    context.lineCap = "round";
    context.lineJoin = "round";
    const turn = level(quaternion(this.values.get("orientation")));
    const ground = SIDES.flatMap((side) => corners(part(body, "soles_to_torso", side)));
    // The lowest corner of a sole stands on the floor.
    const lowest = Math.min(0, ...ground.map((corner) => rotate(turn, corner)[2]));
    const toWorld = (place: Place3): Place3 => {
      const [x, y, z] = rotate(turn, place);
      return [x, y, z - lowest];
    };
    const palette = paletteOf();
    const strokes = [...floor(palette.faint), ...this.body(body, palette.ink).map((stroke) => ({ ...stroke, points: stroke.points.map(toWorld) }))];
    const forces = this.forces(body, toWorld);
    const mass = place3(this.values.get("mass"));
    const all = [...strokes, ...forces.strokes].map((stroke) => ({ ...stroke, depth: nearness(this.view, stroke.points) }));
    all.sort((one, other) => one.depth - other.depth);
    for (const stroke of all) this.stroke(context, stroke);
    if (mass !== null) this.mark(context, toWorld(mass), COLORS[4] as string);
    this.state.textContent = `left ${forces.sums.left.toFixed(1)} N, right ${forces.sums.right.toFixed(1)} N${mass === null ? "" : " · ● centre of mass"}`;
  }

  /** In the torso frame. */
  private body(body: Fields, ink: string): Stroke[] {
    const strokes: Stroke[] = [{ points: [[0, 0, 0.12], [0, 0, -0.085]], color: ink, width: 0.07 }];
    const head = pose3(body["head_to_torso"]);
    if (head !== null) {
      strokes.push({ points: [transform(head, [0, 0, 0.03]), transform(head, [0.02, 0, 0.1])], color: ink, width: 0.1 });
      strokes.push({ points: [transform(head, [0.05, 0, 0.07]), transform(head, [0.16, 0, 0.07])], color: COLORS[0] as string, width: 0.012 });
    }
    for (const side of SIDES) {
      const color = COLORS[side === "left" ? 5 : 2] as string;
      const sign = side === "left" ? 1 : -1;
      const [knee, sole] = [part(body, "knees_to_torso", side), part(body, "soles_to_torso", side)];
      const [elbow, hand] = [part(body, "elbows_to_torso", side), part(body, "hands_to_torso", side)];
      const hip: Place3 = [HIP[0], sign * HIP[1], HIP[2]];
      const shoulder: Place3 = [SHOULDER[0], sign * SHOULDER[1], SHOULDER[2]];
      strokes.push({ points: [[0, 0, SHOULDER[2]], shoulder], color: ink, width: 0.05 }, { points: [[0, 0, HIP[2]], hip], color: ink, width: 0.05 });
      if (knee !== null && sole !== null) strokes.push({ points: [hip, knee.translation, transform(sole, [0, 0, 0.045])], color, width: 0.045 });
      if (elbow !== null) strokes.push({ points: [shoulder, elbow.translation, ...(hand === null ? [] : [hand.translation])], color, width: 0.035 });
      if (sole !== null) strokes.push({ points: [...corners(sole), corners(sole)[0] as Place3], color, width: 0.012 });
    }
    return strokes;
  }

  private forces(body: Fields, toWorld: (place: Place3) => Place3): { strokes: Stroke[]; sums: Record<Side, number> } {
    const sums = { left: 0, right: 0 };
    const strokes: Stroke[] = [];
    for (const side of SIDES) {
      const sole = part(body, "soles_to_torso", side);
      const forces = list(fields(this.values.get("forces"))?.[side]).map((force) => GRAVITY * (number(force) ?? 0));
      forces.forEach((force, at) => {
        sums[side] += force;
        const sensor = SENSORS[at];
        if (sole === null || sensor === undefined || force < 0.2) return;
        const [x, y, z] = toWorld(transform(sole, sensor));
        strokes.push({ points: [[x, y, z], [x, y, z + PER_NEWTON * force]], color: COLORS[1] as string, width: 0.008 });
      });
    }
    return { strokes, sums };
  }

  private project(place: Place3): [number, number] {
    const { around, above, zoom } = this.view;
    const [right, up] = seen(around, above, place);
    const scale = (zoom * Math.min(this.canvas.clientWidth, this.canvas.clientHeight)) / 0.75;
    return [this.canvas.clientWidth / 2 + right * scale, this.canvas.clientHeight / 2 - (up - 0.25) * scale];
  }

  private stroke(context: CanvasRenderingContext2D, { points, color, width }: Stroke): void {
    const scale = (this.view.zoom * Math.min(this.canvas.clientWidth, this.canvas.clientHeight)) / 0.75;
    context.strokeStyle = color;
    context.lineWidth = Math.max(width * scale, 1);
    context.beginPath();
    points.forEach((point, at) => (at === 0 ? context.moveTo(...this.project(point)) : context.lineTo(...this.project(point))));
    context.stroke();
  }

  private mark(context: CanvasRenderingContext2D, place: Place3, color: string): void {
    context.fillStyle = color;
    context.beginPath();
    context.arc(...this.project(place), 6, 0, 2 * Math.PI);
    context.fill();
  }
}

/** To the right and upwards for an eye that looks at the robot, and how near. */
function seen(around: number, above: number, [x, y, z]: Place3): Place3 {
  const [ahead, aside] = [x * Math.cos(around) + y * Math.sin(around), -x * Math.sin(around) + y * Math.cos(around)];
  return [aside, z * Math.cos(above) - ahead * Math.sin(above), ahead * Math.cos(above) + z * Math.sin(above)];
}

function nearness(view: { around: number; above: number }, points: readonly Place3[]): number {
  return points.reduce((sum, point) => sum + seen(view.around, view.above, point)[2], 0) / Math.max(points.length, 1);
}

/** How the torso leans, without where it looks: the robot always looks ahead here. */
function level(orientation: Pose3["rotation"] | null): Pose3["rotation"] {
  if (orientation === null) return [0, 0, 0, 1];
  const [i, j, k, w] = orientation;
  const yaw = Math.atan2(2 * (w * k + i * j), 1 - 2 * (j * j + k * k));
  const [sin, cos] = [Math.sin(-yaw / 2), Math.cos(-yaw / 2)];
  return [cos * i - sin * j, cos * j + sin * i, cos * k + sin * w, cos * w - sin * k];
}

function part(body: Fields, name: string, side: Side): Pose3 | null {
  return pose3(fields(body[name])?.[side]);
}

function corners(sole: Pose3 | null): Place3[] {
  if (sole === null) return [];
  const { front, back, half } = SOLE;
  return ([[front, half, 0], [front, -half, 0], [back, -half, 0], [back, half, 0]] as const).map((corner) => transform(sole, corner));
}

function floor(color: string): Stroke[] {
  const ends = [-0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3];
  return ends.flatMap((at): Stroke[] => [
    { points: [[at, -0.3, -0.002], [at, 0.3, -0.002]], color: `${color}55`, width: 0.001 },
    { points: [[-0.3, at, -0.002], [0.3, at, -0.002]], color: `${color}55`, width: 0.001 },
  ]);
}

export const bodyPose: PanelKind = {
  kind: "pose",
  name: "Pose",
  open: (context) => new PosePanel(context),
  offered: (entries) => ofType(entries, "RobotKinematics") !== undefined,
};
