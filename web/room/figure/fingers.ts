/** Rests a hand's fingers: skeletons are modelled with fingers spread, and nobody stands about like that. */

import { Quaternion, Vector3, type Object3D } from "three";

import { Turn } from "../../avatar/bones.js";

/** From index to little finger: how far each is bent at its three joints, in radians; a resting hand bends the little one most. */
const BENT: Record<string, number> = { Index: 0.18, Middle: 0.22, Ring: 0.26, Pinky: 0.3 };
const JOINTS = [1, 2, 3] as const;
/** Of the angle to the middle finger, what is closed. */
const CLOSED = 0.65;

/** Close and bend the fingers of one hand; `prefix` is Mixamo's side. Hands without all of Mixamo's fingers stay as they are. */
export function restFingers(bones: ReadonlyMap<string, Object3D>, prefix: "Left" | "Right", root: Object3D): void {
  const names = Object.keys(BENT);
  const all = names.map((name) => JOINTS.map((joint) => bones.get(`${prefix}Hand${name}${joint}`)));
  if (!all.every((finger): finger is Object3D[] => finger.every((bone) => bone))) return;
  const fingers = all as Object3D[][];
  const at = (node: Object3D): Vector3 => root.worldToLocal(node.getWorldPosition(new Vector3()));
  const along = (finger: Object3D[]): Vector3 => at(finger[1]!).sub(at(finger[0]!)).normalize();
  const middle = along(fingers[1]!);
  const back = at(fingers[0]![0]!).sub(at(fingers[3]![0]!)).cross(middle).multiplyScalar(prefix === "Left" ? 1 : -1);
  const axis = back.cross(middle).normalize(); // about it fingers bend to the palm
  for (const [index, finger] of fingers.entries()) {
    const from = along(finger);
    const closing = new Quaternion().setFromUnitVectors(from, from.clone().lerp(middle, CLOSED).normalize());
    const bend = new Quaternion().setFromAxisAngle(axis, BENT[names[index]!]!);
    const turns = finger.map((bone) => new Turn(bone, root)); // before the first one moves
    for (const [joint, turn] of turns.entries()) turn.set(joint ? bend : bend.clone().multiply(closing));
  }
}
