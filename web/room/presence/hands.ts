/** Finds the wrists of who wears a headset: of hands that it sees, or of those that hold its controllers. */

import { Matrix4, Quaternion, Vector3 } from "three";

/** A wrist lies so far behind the middle of a fist, in metres: half of a palm and the carpus (Garrett 1971, hand anthropometry). */
const BEHIND_GRIP_M = 0.06;

/**
 * From a grip to the wrist of the hand around it.
 *
 * A grip's z axis comes out of the little finger's side of a fist, y goes along the arm, and x out of the back of a right
 * hand, into that of a left one. A wrist's z axis goes along the arm, y comes out of the back. [1]
 *
 * [1] https://www.w3.org/TR/webxr/#dom-xrinputsource-gripspace, https://www.w3.org/TR/webxr-hand-input-1/#skeleton-joints-section
 */
const WRIST_FROM_GRIP = {
  left: new Matrix4().compose(new Vector3(0, BEHIND_GRIP_M, 0), new Quaternion(-0.5, 0.5, 0.5, 0.5), new Vector3(1, 1, 1)),
  right: new Matrix4().compose(new Vector3(0, BEHIND_GRIP_M, 0), new Quaternion(-0.5, -0.5, -0.5, 0.5), new Vector3(1, 1, 1)),
} as const;

/** The wrist of a source, z along the arm and y out of the back of the hand; undefined while it is not seen, or is no hand's. */
export function wristOf({ hand, gripSpace, handedness }: XRInputSource, frame: XRFrame, space: XRReferenceSpace): Matrix4 | undefined {
  if (handedness === "none") return undefined;
  const joint = hand?.get("wrist");
  const seen = joint && frame.getJointPose?.(joint, space);
  if (seen) return new Matrix4().fromArray(seen.transform.matrix);
  const held = !hand && gripSpace && frame.getPose(gripSpace, space);
  return held ? new Matrix4().fromArray(held.transform.matrix).multiply(WRIST_FROM_GRIP[handedness]) : undefined;
}
