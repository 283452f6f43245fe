// Owns whether two connections are to one run of a robot, of which clock, numbers and paths go on.
import type { Welcome } from "../protocol";

/** By what the robot said first on each. Null: robots of an earlier version do not tell, and whoever has to know guesses. */
export function isSameRun(one: Pick<Welcome, "run"> | null, other: Pick<Welcome, "run"> | null): boolean | null {
  if (one === null || other === null) return null;
  if (one === other) return true;
  const [own, others] = [one.run ?? null, other.run ?? null];
  return own === null && others === null ? null : own === others;
}
