// Owns what the field shows of robots beside the panel's own: where each is and sees the ball, as it says itself.
import { robotColor, robotMark } from "../panels/series";
import type { Entry } from "../protocol";
import type { Robot } from "../store/robot";
import type { Known } from "../store/robots";
import { fields, number, outOf, point, pose, turned, type Point, type Pose } from "./geometry";
import { named, output, Values } from "./values";

const RATE = 10;

/** Number of the shirt and of the team, as far as a robot has them. */
export interface Player {
  number: number | null;
  team: number | null;
}

export interface Other {
  pose: Pose;
  ball: Point | null;
  color: string;
  mark: string;
  player: Player;
}

/** Who a robot plays for. */
export async function playerOf(robot: Robot): Promise<Player> {
  const reading = await robot.ask({ parameters: { path: "player" } }).catch(() => null);
  const player = reading !== null && "parameters" in reading ? fields(reading.parameters.value) : null;
  return { number: number(player?.["number"]), team: number(player?.["team"]) };
}

/** Subscribes to where a robot believes to be, under the names that `believed` reads. */
export function watchBelief(values: Values, entries: readonly Entry[], rate: number): void {
  const watch = (name: string, entry: Entry | undefined): void => values.set(name, entry?.path ?? null, rate);
  watch("believed", output(entries, "ground_to_field", "Isometry<f32, Unit<Complex<f32>>, 2>"));
  watch("report", named(entries, "self_report"));
}

/** Where a robot believes to be on its team's field; null: it does not know. */
export function believed(values: Values): Pose | null {
  return pose(values.get("believed")) ?? pose(fields(values.get("report"))?.["ground_to_field"]);
}

/** One robot beside the panel's own. */
class Watched {
  private readonly values: Values;
  private readonly stop: () => void;
  private player: Player = { number: null, team: null };
  private isThere = false;

  constructor(
    private readonly known: Known,
    private readonly changed: () => void,
  ) {
    const { robot } = known;
    this.values = new Values(robot, changed);
    const stops = [
      robot.welcome.watch((welcome) => {
        if (welcome !== null) void this.find(robot);
      }),
      robot.state.watch((state) => {
        this.isThere = state === "open";
        changed();
      }),
    ];
    this.stop = () => stops.forEach((stop) => stop());
  }

  close(): void {
    this.stop();
    this.values.close();
  }

  /** As this team sees the field; null: the robot is not there, or does not know where it is. */
  seenBy(team: number | null): Other | null {
    const here = this.isThere ? believed(this.values) : null;
    if (here === null) return null;
    const isOpponent = team !== null && this.player.team !== null && team !== this.player.team;
    const place = isOpponent ? turned(here) : here;
    const ball = point(fields(this.values.get("ball"))?.["position"]);
    return { pose: place, ball: ball === null ? null : outOf(place, ball), color: robotColor(this.known.at), mark: robotMark(this.known.at), player: this.player };
  }

  private async find(robot: Robot): Promise<void> {
    const entries = await robot.paths.everything().catch((): readonly Entry[] => []);
    watchBelief(this.values, entries, RATE);
    this.values.set("ball", output(entries, "ball", "Ball")?.path ?? null, RATE);
    this.player = await playerOf(robot);
    this.changed();
  }
}

/** All robots of the page but the panel's own. They are called when somebody wants to see them. */
export class Others {
  private watched: Watched[] = [];

  constructor(
    private readonly robots: readonly Known[],
    private readonly changed: () => void,
  ) {}

  show(areShown: boolean): void {
    if (areShown === this.watched.length > 0) return;
    this.close();
    if (areShown) this.watched = this.robots.map((known) => new Watched(known, this.changed));
  }

  seenBy(team: number | null): Other[] {
    return this.watched.map((one) => one.seenBy(team)).filter((one) => one !== null);
  }

  close(): void {
    for (const one of this.watched) one.close();
    this.watched = [];
  }
}
