// Owns what is really the case in a simulated world: asked of the hardware as long as a panel wants to know.
import { expect } from "../connection/socket";
import type { Json } from "../protocol";
import type { Robot } from "../store/robot";
import { fields, list, number, point, turned, type Fields, type Point, type Pose } from "./geometry";

export const TRUTH = "framework.procedures.truth";
export const DISTURB = "framework.procedures.disturb";

export interface Truth {
  /** As the referee sees the field; `isTurned`: the robot's team sees it from behind. */
  isTurned: boolean;
  robot: Pose;
  ball: Point | null;
  robots: (Pose & { isOwn: boolean; name: string })[];
  /** What people read: score, state of the game. */
  about: string;
}

const PERIOD_MILLISECONDS = 200;

/** Asks until what it returns is called. */
export function watchTruth(robot: Robot, heard: (truth: Truth | null) => void): () => void {
  let isAsked = false;
  const ask = async (): Promise<void> => {
    if (isAsked || document.hidden || robot.state.value !== "open" || !robot.canWrite.value) return;
    isAsked = true;
    try {
      heard(read(fields(expect(await robot.ask({ call: { path: TRUTH, argument: null } }), "called"))));
    } catch {
      heard(null);
    }
    isAsked = false;
  };
  const timer = window.setInterval(() => void ask(), PERIOD_MILLISECONDS);
  return () => window.clearInterval(timer);
}

/** Lets something happen to the world, in the words of a scenario's event. */
export async function disturb(robot: Robot, deed: { [key: string]: Json }): Promise<void> {
  expect(await robot.ask({ call: { path: DISTURB, argument: deed } }), "called");
}

function read(value: Fields | null): Truth | null {
  const robot = poseOf(value);
  if (value === null || robot === null) return null;
  const ball = fields(value["ball"]);
  const robots = list(value["robots"]).flatMap((one) => {
    const [found, other] = [fields(one), poseOf(fields(one))];
    return found === null || other === null ? [] : [{ ...other, isOwn: found["team"] === "own", name: String(number(found["number"]) ?? "") }];
  });
  const direction = point(fields(value["own"])?.["direction"]);
  const isTurned = direction !== null && direction[0] * Math.cos(robot.heading) + direction[1] * Math.sin(robot.heading) < 0;
  return { isTurned, robot, ball: point([ball?.["x"] ?? null, ball?.["y"] ?? null]), robots, about: aboutOf(value) };
}

/** The same in the frame in which the robot's team thinks. */
export function asTeamSees(truth: Truth): Truth {
  if (!truth.isTurned) return truth;
  const { robot, ball, robots } = truth;
  return { ...truth, robot: turned(robot), ball: ball === null ? null : [-ball[0], -ball[1]], robots: robots.map((one) => ({ ...one, ...turned(one), isOwn: !one.isOwn })) };
}

function poseOf(value: Fields | null): Pose | null {
  const [x, y, heading] = ["x", "y", "heading"].map((name) => number(value?.[name]));
  return x == null || y == null || heading == null ? null : { x, y, heading };
}

function aboutOf(value: Fields): string {
  const [score, game] = [fields(value["score"]), fields(value["game"])];
  const parts = [`walked ${(number(value["walked"]) ?? 0).toFixed(2)} m`, `tilt ${(((number(value["tilt"]) ?? 0) * 180) / Math.PI).toFixed(0)}°`];
  if (game !== null) parts.push(`${String(game["state"])}, ${String(score?.["blue"])} : ${String(score?.["red"])}`);
  return parts.join(" · ");
}
