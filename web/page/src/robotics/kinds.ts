// Owns the list of panels about football, and layouts of them. They are offered where the robot's types have what they show.
import type { PanelKind } from "../panels/panel";
import { layoutOf, place, type Preset } from "../store/layout";
import { camera } from "./camera";
import { drive } from "./drive";
import { fieldMap } from "./map";
import { bodyPose } from "./pose";
import { simulator } from "./simulator";

export const ROBOTICS: readonly PanelKind[] = [fieldMap, camera, bodyPose, drive, simulator];

const BODY = "Control.main_outputs.sensor_data";

export const ROBOTICS_PRESETS: readonly Preset[] = [
  {
    name: "Vision",
    needs: ["camera", "map"],
    layout: () =>
      layoutOf([3, place("camera", { path: "VisionTop.main_outputs.image" }), place("camera", { path: "VisionBottom.main_outputs.image" })], [2, place("map"), place("parameters", { words: "detection" })]),
  },
  {
    name: "Motion",
    needs: ["pose", "drive"],
    layout: () =>
      layoutOf(
        [2, place("pose", {}, 3), place("drive", {}, 2)],
        [
          3,
          place("plot", { paths: ["left", "right"].map((side) => `Control.main_outputs.sole_pressures.${side}`), window: 10 }),
          place("plot", { paths: ["left_knee_pitch", "left_hip_pitch", "left_ankle_pitch"].map((joint) => `${BODY}.positions.${joint}`), window: 10 }),
          place("plot", { paths: ["0", "1", "2"].map((axis) => `${BODY}.inertial.gyroscope.${axis}`), window: 10 }),
        ],
      ),
  },
  {
    name: "Match",
    needs: ["replay", "map", "camera"],
    layout: () =>
      layoutOf(
        [3, place("replay", {}, 2), place("map", {}, 3)],
        [2, place("camera", { path: "VisionTop.main_outputs.image" }), place("camera", { path: "VisionBottom.main_outputs.image" })],
      ),
  },
  {
    name: "Game",
    needs: ["map", "camera"],
    layout: () =>
      layoutOf(
        [3, place("map", {}, 3), place("value", { path: "Control.main_outputs.world_state" }, 2)],
        [2, place("camera", { path: "VisionTop.main_outputs.image" }), place("simulator")],
        [2, place("drive"), place("logs")],
      ),
  },
];
