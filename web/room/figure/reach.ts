/** Bends an arm so that its wrist is where a hand is: two bones, as far as they reach, and elbows as people's. */

import { Matrix4, Quaternion, Vector3 } from "three";

/** Where a wrist is in the body's frame, and how the hand is turned: z along its fingers, y out of its back. */
export interface Hand {
  readonly at: Vector3;
  readonly turn: Quaternion;
}

/** Of an arm, nearly all: a wholly straight one has no side on which its elbow lies. */
const STRAIGHT = 0.999;
/** Upper and lower arm come no closer than 30 degrees: an elbow bends by 150 (Kapandji, The Physiology of the Joints, vol. 1). */
const FOLDED = Math.cos(Math.PI / 6);
/** Where the elbow lies of an arm that is held out ahead: below, and a little outwards. */
const AHEAD = new Vector3(0, 0, 1);
const ELBOW_OUT = 0.35;

/** Directions of an arm's two parts, and the axis that its elbow bends about; all of length 1. */
export interface Bent {
  readonly upper: Vector3;
  readonly lower: Vector3;
  readonly hinge: Vector3;
}

/**
 * The axis about which an elbow bends, of an arm whose wrist lies in a direction from its shoulder.
 *
 * The arm is carried from straight ahead by the shortest way. So the elbow of a hanging arm points back, that of a raised
 * one forward and outwards, and of one before the chest down; only straight behind, where no hand is, it is not clear.
 */
export function hinge(towards: Vector3, side: 1 | -1, into = new Vector3()): Vector3 {
  const carried = new Quaternion().setFromUnitVectors(AHEAD, towards);
  const elbow = new Vector3(ELBOW_OUT * side, -1, 0).normalize().applyQuaternion(carried);
  return into.crossVectors(towards, elbow).normalize();
}

/** Bend an arm of two lengths; `offset` goes from shoulder to wrist, all in metres of the body's frame. */
export function bend(offset: Vector3, upperM: number, lowerM: number, side: 1 | -1): Bent {
  const wanted = offset.length();
  const towards = wanted > 1e-6 ? offset.clone().divideScalar(wanted) : AHEAD.clone();
  const least = Math.sqrt(upperM ** 2 + lowerM ** 2 - 2 * upperM * lowerM * FOLDED);
  const far = Math.min(Math.max(wanted, least), STRAIGHT * (upperM + lowerM));
  const axis = hinge(towards, side);
  const cosine = (upperM ** 2 + far ** 2 - lowerM ** 2) / (2 * upperM * far);
  // the elbow lies about the axis from the line to the wrist, by the angle at the shoulder
  const upper = towards.clone().applyAxisAngle(axis, Math.acos(Math.min(1, Math.max(-1, cosine))));
  const lower = towards.multiplyScalar(far).addScaledVector(upper, -upperM).normalize();
  return { upper, lower, hinge: axis };
}

const matrix = new Matrix4();

/** The rotation that brings x to a direction, and y as near to a second one as it can. */
export function facing(direction: Vector3, second: Vector3): Quaternion {
  const third = new Vector3().crossVectors(direction, second).normalize();
  return new Quaternion().setFromRotationMatrix(matrix.makeBasis(direction, new Vector3().crossVectors(third, direction), third));
}

/** Of a rotation, what turns about an axis. */
export function twist(rotation: Quaternion, axis: Vector3): Quaternion {
  const along = rotation.x * axis.x + rotation.y * axis.y + rotation.z * axis.z;
  const turned = new Quaternion(axis.x * along, axis.y * along, axis.z * along, rotation.w);
  if (turned.lengthSq() < 1e-12) return turned.identity();
  if (turned.w < 0) turned.set(-turned.x, -turned.y, -turned.z, -turned.w);
  return turned.normalize();
}
