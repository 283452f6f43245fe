// Owns how a robot's values are read as places and poses: whatever does not look like one is null, never an error.
import type { Decoded } from "../connection/binary";

export type Point = readonly [number, number];
export type Place3 = readonly [number, number, number];
/** In rad, against the x axis. */
export interface Pose {
  x: number;
  y: number;
  heading: number;
}

export interface Pose3 {
  /** i, j, k, w. */
  rotation: readonly [number, number, number, number];
  translation: Place3;
}

export type Fields = { [key: string]: Decoded };

export function fields(value: Decoded | undefined): Fields | null {
  const isObject = value !== null && typeof value === "object" && !Array.isArray(value) && !(value instanceof Uint8Array);
  return isObject ? (value as Fields) : null;
}

export function list(value: Decoded | undefined): Decoded[] {
  return Array.isArray(value) ? (value as Decoded[]) : [];
}

export function number(value: Decoded | undefined): number | null {
  if (typeof value === "bigint") return Number(value);
  return typeof value === "number" && Number.isFinite(value) ? value : null;
}

function numbers(value: Decoded | undefined, count: number): number[] | null {
  const all = list(value);
  return all.length >= count && all.slice(0, count).every((one) => number(one) !== null) ? (all.slice(0, count) as number[]) : null;
}

export function point(value: Decoded | undefined): Point | null {
  return numbers(value, 2) as Point | null;
}

export function place3(value: Decoded | undefined): Place3 | null {
  return numbers(value, 3) as Place3 | null;
}

/** An isometry of the plane: its rotation is a complex number. */
export function pose(value: Decoded | undefined): Pose | null {
  const found = fields(value);
  const [rotation, translation] = [point(found?.["rotation"]), point(found?.["translation"])];
  if (rotation === null || translation === null) return null;
  return { x: translation[0], y: translation[1], heading: Math.atan2(rotation[1], rotation[0]) };
}

export function pose3(value: Decoded | undefined): Pose3 | null {
  const found = fields(value);
  const [rotation, translation] = [quaternion(found?.["rotation"]), place3(found?.["translation"])];
  return rotation === null || translation === null ? null : { rotation, translation };
}

export function quaternion(value: Decoded | undefined): Pose3["rotation"] | null {
  return numbers(value, 4) as unknown as Pose3["rotation"] | null;
}

/** A point of the pose's own frame, in the frame where the pose stands. */
export function outOf(pose: Pose, [x, y]: Point): Point {
  const [cos, sin] = [Math.cos(pose.heading), Math.sin(pose.heading)];
  return [pose.x + cos * x - sin * y, pose.y + sin * x + cos * y];
}

export function rotate([i, j, k, w]: Pose3["rotation"], [x, y, z]: Place3): Place3 {
  const [a, b, c] = [2 * (j * z - k * y), 2 * (k * x - i * z), 2 * (i * y - j * x)];
  return [x + w * a + j * c - k * b, y + w * b + k * a - i * c, z + w * c + i * b - j * a];
}

export function transform({ rotation, translation }: Pose3, place: Place3): Place3 {
  const [x, y, z] = rotate(rotation, place);
  return [x + translation[0], y + translation[1], z + translation[2]];
}

/** Half axes and the turn of the ellipse of one standard deviation. */
export function ellipse(covariance: Decoded | undefined): { long: number; short: number; turn: number } | null {
  const all = list(covariance).flatMap((one) => (Array.isArray(one) ? (one as Decoded[]) : [one]));
  // Row by row or column by column is the same: it is symmetric.
  const [xx, xy, yx, yy] = all.length === 4 ? all.map(number) : [];
  if (xx == null || xy == null || yx == null || yy == null) return null;
  const [middle, spread] = [(xx + yy) / 2, Math.hypot((xx - yy) / 2, (xy + yx) / 2)];
  const [long, short] = [Math.sqrt(Math.max(middle + spread, 0)), Math.sqrt(Math.max(middle - spread, 0))];
  return { long, short, turn: Math.atan2(xy + yx, xx - yy) / 2 };
}

/** The other team's field is the own one from behind. */
export function turned({ x, y, heading }: Pose): Pose {
  return { x: -x, y: -y, heading: heading + Math.PI };
}
