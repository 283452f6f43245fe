// Owns how numbers and times are written for people.
import { writeJson } from "../connection/exact";

/** Six digits are more than a screen shows apart, and do not jump in width. */
export function number(value: number): string {
  if (Number.isInteger(value)) return String(value);
  if (!Number.isFinite(value)) return String(value).replace("Infinity", "inf");
  const size = Math.abs(value);
  return size >= 1e6 || size < 1e-4 ? value.toExponential(4) : value.toPrecision(6);
}

/** A duration in microseconds. */
export function microseconds(value: number): string {
  if (value < 1000) return `${value.toFixed(value < 10 ? 2 : 1)} µs`;
  return value < 1e6 ? `${(value / 1e3).toFixed(2)} ms` : `${(value / 1e6).toFixed(2)} s`;
}

/** A time of the robot's clock, given in nanoseconds. */
export function seconds(nanoseconds: number): string {
  return `${(nanoseconds / 1e9).toFixed(3)} s`;
}

/** "1 cycle", "2 cycles". */
export function plural(count: number, noun: string): string {
  return `${count} ${noun}${count === 1 ? "" : "s"}`;
}

/** A value as JSON; bytes become numbers again. */
export function json(value: unknown): string {
  return writeJson(value, 2);
}
