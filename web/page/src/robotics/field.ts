// Owns the markings of the field: those of the parameters where the robot has them, else of the league's rules 2023 to 2025.
import { number, type Fields, type Point } from "./geometry";

export interface FieldSize {
  length: number;
  width: number;
  goalAreaLength: number;
  goalAreaWidth: number;
  penaltyAreaLength: number;
  penaltyAreaWidth: number;
  circleRadius: number;
  penaltyMark: number;
  goalWidth: number;
  border: number;
}

/** In metres. */
export const RULES: FieldSize = {
  length: 9,
  width: 6,
  goalAreaLength: 0.6,
  goalAreaWidth: 2.2,
  penaltyAreaLength: 1.65,
  penaltyAreaWidth: 4,
  circleRadius: 0.75,
  penaltyMark: 1.3,
  goalWidth: 1.6,
  border: 0.7,
};

const NAMES: Partial<Record<keyof FieldSize, string>> = {
  length: "length",
  width: "width",
  goalAreaLength: "goal_area_length",
  goalAreaWidth: "goal_area_width",
  penaltyAreaLength: "penalty_area_length",
  penaltyAreaWidth: "penalty_area_width",
  penaltyMark: "penalty_mark_distance",
  goalWidth: "goal_width",
};

export function fieldOf(parameters: Fields | null): FieldSize {
  const size = { ...RULES };
  for (const [key, name] of Object.entries(NAMES) as [keyof FieldSize, string][]) size[key] = number(parameters?.[name]) ?? size[key];
  return size;
}

/** Lines from end to end, in the field frame. */
export function markings(size: FieldSize): (readonly [Point, Point])[] {
  const [x, y] = [size.length / 2, size.width / 2];
  const lines: (readonly [Point, Point])[] = [
    [[-x, -y], [x, -y]],
    [[-x, y], [x, y]],
    [[0, -y], [0, y]],
  ];
  for (const side of [-1, 1]) {
    lines.push([[side * x, -y], [side * x, y]]);
    for (const [depth, width] of [[size.goalAreaLength, size.goalAreaWidth], [size.penaltyAreaLength, size.penaltyAreaWidth]] as const) {
      const [inner, half] = [side * (x - depth), width / 2];
      lines.push([[side * x, -half], [inner, -half]], [[inner, -half], [inner, half]], [[inner, half], [side * x, half]]);
    }
  }
  return lines;
}
