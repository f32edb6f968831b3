/** What an avatar is told of one moment, and the angles in it. */

import { Euler, Quaternion } from "three";

import { FULL_PITCH_RAD, FULL_YAW_RAD, SHAPE_INDEX } from "./shapes.js";

/**
 * Angles are radians: yaw to the subject's left, pitch upwards, roll towards the left shoulder. Left is the subject's.
 */
export interface Face {
  /** 52 numbers in the order of `SHAPES`; NaN where nothing is known. */
  readonly weights: ArrayLike<number>;
  /** Yaw and pitch of the left eye, then of the right eye; without it the eyeLook weights tell. */
  readonly gaze?: readonly [number, number, number, number] | undefined;
  /** Yaw, pitch and roll of the head; without it the head rests. */
  readonly head?: readonly [number, number, number] | undefined;
}

const euler = new Euler(0, 0, 0, "YXZ");

/** The rotation of what looks along +z, y up, x to the subject's left (glTF's frame). */
export function rotation(yaw: number, pitch: number, roll: number, into = new Quaternion()): Quaternion {
  return into.setFromEuler(euler.set(-pitch, yaw, -roll, "YXZ"));
}

/** Yaw and pitch of both eyes, as given, or as the eyeLook weights tell. */
export function gazeOf(face: Face): [number, number, number, number] {
  if (face.gaze?.every(Number.isFinite)) return [...face.gaze];
  const weight = (name: string): number => finite(face.weights[SHAPE_INDEX.get(name)!]);
  return [
    FULL_YAW_RAD * (weight("eyeLookOutLeft") - weight("eyeLookInLeft")),
    FULL_PITCH_RAD * (weight("eyeLookUpLeft") - weight("eyeLookDownLeft")),
    FULL_YAW_RAD * (weight("eyeLookInRight") - weight("eyeLookOutRight")),
    FULL_PITCH_RAD * (weight("eyeLookUpRight") - weight("eyeLookDownRight")),
  ];
}

/** A weight that can be applied: 0 where nothing is known. */
export function finite(weight: number | undefined): number {
  return weight !== undefined && Number.isFinite(weight) ? weight : 0;
}
