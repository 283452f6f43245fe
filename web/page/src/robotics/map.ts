// A panel with the field from above: what the robot believes, what its team says, and in simulation what is really there.
import { button, eachFrame, make } from "../view/dom";
import type { Context, Panel, PanelKind } from "../panels/panel";
import { COLORS, robotColor, robotMark } from "../panels/series";
import type { Entry } from "../protocol";
import { Chart } from "./chart";
import { fieldOf, RULES, type FieldSize } from "./field";
import { ellipse, fields, list, number, outOf, point, pose, type Point, type Pose } from "./geometry";
import { believed, Others, playerOf, watchBelief, type Other, type Player } from "./others";
import { asTeamSees, TRUTH, watchTruth, type Truth } from "./truth";
import { named, ofType, output, Values } from "./values";

/** Told apart without colour, too: by shape, by fill, and by the letters beside them. */
const [OWN, BALL, , , OTHER, MATE] = COLORS as [string, string, string, string, string, string];
const LAYERS = ["truth", "lines", "obstacles", "team", "robots", "trail"] as const;
type Layer = (typeof LAYERS)[number];
const RATE = 15;
const TRAIL = 400;
/** Closer together than the robot's own noise: such places are one. */
const TRAIL_STEP = 0.02;

class FieldMap implements Panel {
  readonly content: HTMLElement;
  readonly tools: HTMLElement[];
  private readonly draw = eachFrame(() => this.paint());
  private readonly values: Values;
  private readonly canvas = make("canvas", { class: "field", role: "img", "aria-label": "field from above", tabindex: "0" });
  private readonly chart = new Chart(this.canvas, this.draw);
  private readonly state = make("output", { class: "muted" });
  private readonly hidden: Set<Layer>;
  private readonly stop: () => void;
  private stopTruth = (): void => undefined;
  private isClosed = false;
  private size: FieldSize = RULES;
  private truth: Truth | null = null;
  private trail: Point[] = [];
  private player: Player = { number: null, team: null };
  private readonly others: Others;
  /** Of the panel's robot. */
  private color = OWN;
  private mark = "";

  constructor(private readonly context: Context) {
    this.hidden = new Set(LAYERS.filter((layer) => context.settings[layer] === false));
    this.values = new Values(context.robot, this.draw);
    const { robots, known: own } = context;
    this.others = new Others(robots.filter((known) => known !== own), this.draw);
    if (robots.length > 1) [this.color, this.mark] = [robotColor(own.at), robotMark(own.at)];
    this.others.show(!this.hidden.has("robots"));
    const layers = LAYERS.filter((layer) => layer !== "robots" || robots.length > 1).map((layer) => {
      const box = make("input", { type: "checkbox", checked: !this.hidden.has(layer) });
      box.addEventListener("change", () => this.show(layer, box.checked));
      return make("label", { class: "layer" }, box, layer);
    });
    this.content = make("div", { class: "map" }, make("div", { class: "bar layers" }, ...layers, make("span", { class: "space" }), this.state), this.canvas);
    this.tools = [button("Whole", "show the whole field again", () => this.chart.whole())];
    this.canvas.addEventListener("pointerdown", (event) => this.chart.pan(event));
    this.stop = context.robot.welcome.watch((welcome) => {
      if (welcome !== null) void this.find();
    });
  }

  close(): void {
    this.isClosed = true;
    this.stop();
    this.stopTruth();
    this.others.close();
    this.values.close();
  }

  resized(): void {
    this.draw();
  }

  private show(layer: Layer, isShown: boolean): void {
    if (isShown) this.hidden.delete(layer);
    else this.hidden.add(layer);
    if (layer === "robots") this.others.show(isShown);
    this.context.save(Object.fromEntries([...this.hidden].map((one) => [one, false])));
    this.draw();
  }

  /** What of all this the robot has. */
  private async find(): Promise<void> {
    const entries = await this.context.robot.paths.everything().catch((): readonly Entry[] => []);
    const watch = (name: string, entry: Entry | undefined, rate = RATE): void => this.values.set(name, entry?.path ?? null, rate);
    watch("ball", output(entries, "ball", "Ball"));
    watch("hypotheses", named(entries, "ball_filter.hypotheses"), 5);
    watch("obstacles", named(entries, "obstacles.0") ?? ofType(entries, "Vec<Obstacle>", "obstacles"));
    watch("team", output(entries, "teammates", "Vec<Teammate>"), 5);
    watch("odometry", output(entries, "odometry", "Odometry"));
    watchBelief(this.values, entries, RATE);
    watch("command", output(entries, "motion_command", "MotionCommand"));
    watch("path", named(entries, "path") ?? named(entries, "planned_path"), 5);
    const cameras = entries.filter((entry) => /^[^.]+\.main_outputs\.lines$/.test(entry.path));
    [0, 1].forEach((at) => watch(`lines ${at}`, cameras[at]));
    if (this.isClosed) return;
    this.stopTruth();
    this.truth = null;
    if (entries.some((entry) => entry.path === TRUTH)) {
      this.stopTruth = watchTruth(this.context.robot, (truth) => {
        this.truth = truth === null ? null : asTeamSees(truth);
        this.draw();
      });
    }
    this.player = await playerOf(this.context.robot);
    const reading = await this.context.robot.ask({ parameters: { path: "field_dimensions" } }).catch(() => null);
    if (reading !== null && "parameters" in reading) this.size = fieldOf(fields(reading.parameters.value));
    this.draw();
  }

  /** Where the robot is on the field, and who says so. */
  private pose(): { pose: Pose; from: string; isOnField: boolean } {
    const own = believed(this.values);
    if (own !== null) return { pose: own, from: "placed by its own estimate", isOnField: true };
    if (this.truth !== null) return { pose: this.truth.robot, from: "placed by the simulation", isOnField: true };
    const odometry = pose(fields(this.values.get("odometry"))?.["ground_to_start"]);
    return { pose: odometry ?? { x: 0, y: 0, heading: 0 }, from: "placed by odometry: it does not know where the field is", isOnField: false };
  }

  private paint(): void {
    const { pose: robot, from, isOnField } = this.pose();
    const context = this.chart.begin(this.size, isOnField);
    if (context === null) return;
    this.follow(robot);
    if (!this.hidden.has("trail")) this.paintTrail(context);
    if (!this.hidden.has("lines")) this.paintLines(context, robot);
    if (!this.hidden.has("truth")) this.paintTruth(context);
    if (!this.hidden.has("obstacles")) this.paintObstacles(context, robot);
    // What others say of the field is of no use to a robot that does not know where it is.
    const others = isOnField ? this.others.seenBy(this.player.team) : [];
    if (isOnField && !this.hidden.has("team")) this.paintTeam(context, others);
    for (const other of others) this.paintOther(context, other);
    this.paintPlan(context, robot);
    this.paintBall(context, robot);
    this.chart.robot(context, robot, this.color, this.mark, false);
    const about = this.truth === null || this.hidden.has("truth") ? "" : ` · ${this.truth.about}`;
    this.state.textContent = `x ${robot.x.toFixed(2)} m, y ${robot.y.toFixed(2)} m, ${((robot.heading * 180) / Math.PI).toFixed(0)}° · ${from}${about}`;
  }

  private follow({ x, y }: Pose): void {
    const last = this.trail.at(-1);
    const step = last === undefined ? Infinity : Math.hypot(x - last[0], y - last[1]);
    // Nobody walks a metre between two pictures: it was carried, or began anew.
    if (step > 1) this.trail = [];
    if (step >= TRAIL_STEP) this.trail = [...this.trail.slice(1 - TRAIL), [x, y]];
  }

  private paintTrail(context: CanvasRenderingContext2D): void {
    context.strokeStyle = this.color;
    context.lineWidth = 2;
    context.setLineDash([2, 4]);
    this.chart.line(context, this.trail);
    context.setLineDash([]);
  }

  private paintLines(context: CanvasRenderingContext2D, robot: Pose): void {
    context.strokeStyle = COLORS[3] as string;
    context.lineWidth = 3;
    for (const value of list(this.values.get("lines 0")).concat(list(this.values.get("lines 1")))) {
      const [start, end] = [point(fields(value)?.["start"]), point(fields(value)?.["end"])];
      if (start !== null && end !== null) this.chart.line(context, [outOf(robot, start), outOf(robot, end)]);
    }
  }

  /** Outlines alone: what is there, behind what the robot thinks. */
  private paintTruth(context: CanvasRenderingContext2D): void {
    if (this.truth === null) return;
    context.setLineDash([5, 3]);
    this.chart.robot(context, this.truth.robot, this.color, "", true);
    for (const other of this.truth.robots) this.chart.robot(context, other, other.isOwn ? MATE : OTHER, other.name, true);
    context.lineWidth = 2;
    if (this.truth.ball !== null) this.chart.disc(context, this.truth.ball, 0.05, null, BALL);
    context.setLineDash([]);
  }

  private paintObstacles(context: CanvasRenderingContext2D, robot: Pose): void {
    context.lineWidth = 2;
    for (const value of list(this.values.get("obstacles"))) {
      const obstacle = fields(value);
      const at = point(obstacle?.["position"]);
      if (at === null) continue;
      const place = outOf(robot, at);
      this.chart.disc(context, place, number(obstacle?.["radius"]) ?? 0.1, `${OTHER}66`, OTHER);
      this.chart.text(context, place, String(obstacle?.["kind"] ?? "?").slice(0, 1), "#ffffff");
    }
  }

  private paintOther(context: CanvasRenderingContext2D, { pose, ball, color, mark }: Other): void {
    context.lineWidth = 2;
    if (ball !== null) this.chart.disc(context, ball, 0.05, BALL, color);
    this.chart.robot(context, pose, color, mark, false);
  }

  /** What mates say over the network, but of those who say it to this page themselves. */
  private paintTeam(context: CanvasRenderingContext2D, others: readonly Other[]): void {
    const isHere = (player: number | null): boolean => others.some((other) => player !== null && other.player.number === player && other.player.team === this.player.team);
    for (const value of list(this.values.get("team"))) {
      const message = fields(fields(value)?.["message"]);
      const mate = pose(message?.["ground_to_field"]);
      if (mate === null || isHere(number(message?.["player_number"]))) continue;
      const name = String(message?.["player_number"] ?? "?");
      const color = COLORS[(2 + Number(name)) % COLORS.length] ?? MATE;
      this.chart.robot(context, mate, color, name, false);
      const ball = point(fields(message?.["ball"])?.["position"]);
      context.lineWidth = 1.5;
      if (ball !== null) this.chart.disc(context, outOf(mate, ball), 0.05, null, color);
    }
  }

  private paintPlan(context: CanvasRenderingContext2D, robot: Pose): void {
    context.strokeStyle = "#ffffff";
    context.lineWidth = 2;
    const path = list(this.values.get("path")).map(point).filter((one) => one !== null);
    if (path.length > 1) this.chart.line(context, path.map((one) => outOf(robot, one)));
    const step = fields(fields(this.values.get("command"))?.["step"]);
    const [forward, left] = [number(step?.["forward"]) ?? 0, number(step?.["left"]) ?? 0];
    // A step of 6 cm is an arrow of 60 cm.
    if (Math.hypot(forward, left) > 0.001) this.chart.line(context, [[robot.x, robot.y], outOf(robot, [10 * forward, 10 * left])]);
  }

  private paintBall(context: CanvasRenderingContext2D, robot: Pose): void {
    const ball = fields(this.values.get("ball"));
    context.lineWidth = 1.5;
    for (const value of list(this.values.get("hypotheses"))) {
      const guess = fields(value);
      const [at, axes] = [point(guess?.["position"]), ellipse(guess?.["covariance"])];
      if (at !== null && axes !== null) this.chart.ellipse(context, outOf(robot, at), axes, robot.heading, BALL);
    }
    const at = point(ball?.["position"]);
    if (at === null) return;
    const place = outOf(robot, at);
    context.lineWidth = 2;
    const axes = ellipse(ball?.["covariance"]);
    if (axes !== null) this.chart.ellipse(context, place, axes, robot.heading, BALL);
    const velocity = point(ball?.["velocity"]);
    context.strokeStyle = BALL;
    if (velocity !== null) this.chart.line(context, [place, outOf(robot, [at[0] + velocity[0], at[1] + velocity[1]])]);
    this.chart.disc(context, place, 0.05, BALL, "#ffffff");
  }
}

export const fieldMap: PanelKind = {
  kind: "map",
  name: "Field",
  open: (context) => new FieldMap(context),
  showsRobots: true,
  offered: (entries) => ofType(entries, "Ball") !== undefined || ofType(entries, "Vec<LineSegment>") !== undefined,
};
