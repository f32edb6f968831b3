/**
 * Finds the face in each picture (MediaPipe), and makes of its points the 52 weights (facegen's own networks).
 *
 * All that it loads comes from this server: `make room-face` puts it there, the detector by the hashes of package-lock.json, its
 * model by the hash that track holds, the networks from the ready-made model.
 */

import { FaceLandmarker, FilesetResolver, type FaceLandmarkerResult, type NormalizedLandmark } from "@mediapipe/tasks-vision";

import table from "../../../regress/data/mediapipe_points.json";
import { FULL_PITCH_RAD, FULL_YAW_RAD, SHAPE_INDEX } from "../../avatar/shapes.js";

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

/** Of the neutral face, which is their median: a blink of a third of a second is less than half of them. */
const NEUTRAL = { frames: 10, ms: 700 };
/** An eye's width over how far its iris lies from where it turns: 30 and 10.8 mm (`regress.runtime.heads.eyes`). */
const REACHES_PER_WIDTH = 30 / 10.8;
const MOST_EYE_RAD = 0.7;
/** One-Euro filter (Casiez et al. 2012): at rest 2.5 Hz pass, and the more the faster a weight moves. */
const CUTOFF_HZ = 2.5;
const BETA = 6;

const VERTICES = Object.values(table.landmarks).flat() as number[][];
const EYES = [
  { iris: table.irises.left, inner: 362, outer: 263 },
  { iris: table.irises.right, inner: 33, outer: 133 },
] as const;

type Triple = [number, number, number];

let detector: FaceLandmarker;
let networks: Networks;
let predict: (points: ArrayLike<number>) => Float32Array;
let order: number[];
let collecting: { points: Float64Array; gaze: number[]; place: Triple; head: Triple; time: number }[] | undefined;
let calibrated = false;
let rest = { gaze: [0, 0, 0, 0], place: undefined as Triple | undefined, head: [0, 0, 0] as Triple };
let smooth: { time: number; values: Float32Array; speeds: Float32Array } | undefined;

const tell = (message: FromWorker): void => postMessage(message);

async function start(): Promise<void> {
  // three names that the server has; a path in a variable keeps the bundler from looking for it at build time
  const made = "/static/face/face.js";
  networks = (await import(made)) as Networks;
  predict = networks.player(new Float64Array(136));
  order = networks.names.map((name) => SHAPE_INDEX.get(name)!);
  const files = await FilesetResolver.forVisionTasks("/static/face", true);
  detector = await FaceLandmarker.createFromOptions(files, {
    baseOptions: { modelAssetPath: "/static/face/face_landmarker.task", delegate: "CPU" },
    runningMode: "VIDEO",
    numFaces: 1,
    outputFacialTransformationMatrixes: true,
  });
  tell({ kind: "ready" });
}

const started = start().catch((error: unknown) => {
  tell({ kind: "failed", text: `The face detector cannot be loaded (${error instanceof Error ? error.message : error}).` });
  throw error;
});

onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  await started;
  try {
    answer(data);
  } catch (error) {
    // one picture that cannot be read; without an answer no other would come
    console.warn("face:", error);
    tell({ kind: "nobody" });
  }
};

let latest = 0;

function answer(data: ToWorker): void {
  if (data.kind === "neutral") {
    collecting = [];
    return;
  }
  const begun = performance.now();
  const { picture } = data;
  // browsers coarsen their clocks, and the detector wants times that rise
  const time = (latest = Math.max(data.time, latest + 0.001));
  const [width, height] = [picture.width, picture.height];
  const found = detect(picture, time);
  const [mesh] = found.faceLandmarks;
  const matrix = found.facialTransformationMatrixes[0]?.data;
  if (!mesh || !matrix) return nobody();
  const points = landmarks(mesh, width, height);
  const gaze = EYES.flatMap((eye) => gazeOf(mesh, eye, width, height));
  const place: Triple = [matrix[12]! / 100, matrix[13]! / 100, matrix[14]! / 100];
  const head = angles(matrix);
  if (![...points, ...gaze, ...place, ...head].every(Number.isFinite)) return nobody(); // one would stay in all that follow
  rest.place ??= place;
  collect({ points, gaze, place, head, time });
  const weights = new Float32Array(order.length);
  predict(points).forEach((weight, index) => (weights[order[index]!] = Math.min(1, Math.max(0, weight))));
  if (!weights.every(Number.isFinite)) return nobody();
  const turned = gaze.map((angle, index) => angle - rest.gaze[index]!) as [number, number, number, number];
  look(weights, turned);
  tell({
    kind: "face",
    weights: smoothed(weights, time),
    gaze: turned,
    head: head.map((angle, index) => angle - rest.head[index]!) as Triple,
    head_m: place.map((metres, index) => metres - rest.place![index]!) as Triple,
    calibrated,
    ms: performance.now() - begun,
  });
}

/** No face is in this picture, or none that can be shown. */
function nobody(): void {
  smooth = undefined;
  if (collecting) collecting = []; // somebody else may come back
  tell({ kind: "nobody" });
}

function detect(picture: ImageBitmap, time: number): FaceLandmarkerResult {
  try {
    return detector.detectForVideo(picture, time);
  } finally {
    picture.close();
  }
}

/** 68 landmarks in pixels, x y x y ... */
function landmarks(mesh: NormalizedLandmark[], width: number, height: number): Float64Array {
  const points = new Float64Array(2 * VERTICES.length);
  VERTICES.forEach((vertices, index) => {
    for (const vertex of vertices) {
      points[2 * index]! += (mesh[vertex]!.x * width - 0.5) / vertices.length;
      points[2 * index + 1]! += (mesh[vertex]!.y * height - 0.5) / vertices.length;
    }
  });
  return points;
}

/** Yaw to the person's left and pitch upwards, by how far the iris is from the middle of its eye's corners. */
function gazeOf(mesh: NormalizedLandmark[], eye: (typeof EYES)[number], width: number, height: number): [number, number] {
  const at = (vertex: number): [number, number] => [mesh[vertex]!.x * width, mesh[vertex]!.y * height];
  const [iris, a, b] = [at(eye.iris), at(eye.inner), at(eye.outer)];
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const span = Math.hypot(dx, dy) || 1;
  const [ox, oy] = [iris[0] - (a[0] + b[0]) / 2, iris[1] - (a[1] + b[1]) / 2];
  const along = (ox * dx + oy * dy) / span / span;
  const down = (oy * dx - ox * dy) / span / span;
  const angle = (share: number): number => Math.max(-MOST_EYE_RAD, Math.min(MOST_EYE_RAD, Math.asin(Math.max(-1, Math.min(1, REACHES_PER_WIDTH * share)))));
  return [angle(along), -angle(down)];
}

/** Yaw, pitch and roll of MediaPipe's matrix (by columns; x to the picture's right, y up, z to the viewer). */
function angles(matrix: ArrayLike<number>): Triple {
  const scale = Math.cbrt(
    matrix[0]! * (matrix[5]! * matrix[10]! - matrix[9]! * matrix[6]!) -
      matrix[4]! * (matrix[1]! * matrix[10]! - matrix[9]! * matrix[2]!) +
      matrix[8]! * (matrix[1]! * matrix[6]! - matrix[5]! * matrix[2]!),
  );
  const pitchDown = Math.asin(Math.max(-1, Math.min(1, -matrix[9]! / scale)));
  return [Math.atan2(matrix[8]!, matrix[10]!), -pitchDown, -Math.atan2(matrix[1]!, matrix[5]!)];
}

/** Lids follow the eyes, also on avatars whose eyes have bones. */
function look(weights: Float32Array, [leftYaw, leftPitch, rightYaw, rightPitch]: [number, number, number, number]): void {
  const set = (name: string, weight: number): void => void (weights[SHAPE_INDEX.get(name)!] = Math.max(0, Math.min(1, weight)));
  set("eyeLookOutLeft", leftYaw / FULL_YAW_RAD);
  set("eyeLookInLeft", -leftYaw / FULL_YAW_RAD);
  set("eyeLookUpLeft", leftPitch / FULL_PITCH_RAD);
  set("eyeLookDownLeft", -leftPitch / FULL_PITCH_RAD);
  set("eyeLookInRight", rightYaw / FULL_YAW_RAD);
  set("eyeLookOutRight", -rightYaw / FULL_YAW_RAD);
  set("eyeLookUpRight", rightPitch / FULL_PITCH_RAD);
  set("eyeLookDownRight", -rightPitch / FULL_PITCH_RAD);
}

/** Towards a neutral face, once the person has asked for one. */
function collect(frame: NonNullable<typeof collecting>[number]): void {
  if (!collecting) return;
  collecting.push(frame);
  const frames = collecting;
  if (frames.length < NEUTRAL.frames || frame.time - frames[0]!.time < NEUTRAL.ms) return;
  const median = (get: (one: typeof frame) => ArrayLike<number>): number[] =>
    Array.from(get(frame), (_, index) => frames.map((one) => get(one)[index]!).sort((a, b) => a - b)[frames.length >> 1]!);
  predict = networks.player(median((one) => one.points));
  rest = { gaze: median((one) => one.gaze), place: median((one) => one.place) as Triple, head: median((one) => one.head) as Triple };
  calibrated = true;
  collecting = undefined;
}

function smoothed(weights: Float32Array, time: number): Float32Array {
  if (!smooth) {
    smooth = { time, values: weights.slice(), speeds: new Float32Array(weights.length) };
    return weights;
  }
  const seconds = Math.max(1e-3, (time - smooth.time) / 1000);
  const share = (hertz: number): number => 1 / (1 + 1 / (2 * Math.PI * hertz * seconds));
  smooth.time = time;
  for (let i = 0; i < weights.length; i++) {
    const speed = (weights[i]! - smooth.values[i]!) / seconds;
    smooth.speeds[i]! += (speed - smooth.speeds[i]!) * share(1);
    smooth.values[i]! += (weights[i]! - smooth.values[i]!) * share(CUTOFF_HZ + BETA * Math.abs(smooth.speeds[i]!));
  }
  return smooth.values.slice();
}
