/**
 * Finds the face in each picture (MediaPipe), and makes of its points the 52 weights (facegen's own networks).
 *
 * All three files that it loads come from this server: `make web` puts them there, by the hashes of package-lock.json, of
 * track's model and of the model folder.
 */

import { FaceLandmarker, FilesetResolver, type NormalizedLandmark } from "@mediapipe/tasks-vision";

import table from "../../track/detectors/data/mediapipe_points.json";
import { FULL_PITCH_RAD, FULL_YAW_RAD } from "./looks.js";

export type ToWorker = { kind: "picture"; picture: ImageBitmap; time: number } | { kind: "neutral" };
export type FromWorker =
  | { kind: "ready" }
  | { kind: "failed"; text: string }
  | { kind: "nobody" }
  | {
      kind: "face";
      weights: Float32Array;
      gaze: [number, number, number, number];
      head: [number, number, number];
      head_m: [number, number, number];
      calibrated: boolean;
      ms: number;
    };

interface Networks {
  readonly names: string[];
  player(neutral: ArrayLike<number>): (points: ArrayLike<number>) => Float32Array;
}
