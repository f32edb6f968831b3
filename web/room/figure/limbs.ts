/** Moves arms and legs, of a skeleton or of the simple body, towards what hands, a gesture, a seat or a step ask of them. */

import { Quaternion, Vector3, type Object3D } from "three";
import type { VRM, VRMHumanBoneName } from "@pixiv/three-vrm";

import { Turn } from "../../avatar/bones.js";
import { Arm, type Palm } from "./arm.js";
import { restFingers } from "./fingers.js";
import type { Hand } from "./reach.js";

/**
 * Directions of a limb's two parts in the body's frame: x to the left, y up, z forward; of the left side, mirrored for the
 * right. `roll` turns the lower part about itself, in radians: a palm that faces inwards comes to face down.
 */
type Directions = readonly [upper: readonly [number, number, number], lower: readonly [number, number, number], roll?: number];
/** Nothing of an arm that a gesture leaves at rest. */
type Gesture = (seconds: number, side: 1 | -1) => Directions | undefined;

/** `ahead` is how far a step swings the arm. */
function hanging(seconds: number, ahead: number): Directions {
  return [
    [0.16, -1, 0.03 * Math.sin(1.3 * seconds) + ahead],
    [0.1, -1, 0.28 + ahead],
  ];
}
/** Hands on the thighs, palms down: hanging, they would go through the chair. */
const ON_THIGHS: Directions = [[0.14, -0.97, 0.18], [-0.16, -0.36, 0.9], 1.1];

const rightAlone =
  (gesture: Gesture): Gesture =>
  (seconds, side) =>
    side === -1 ? gesture(seconds, side) : undefined;

/** By animation's number (`ANIMATIONS`); nods and shakes are the head's. */
const ARMS: Record<number, Gesture> = {
  1: rightAlone((seconds) => [
    [0.8, -0.45, 0.35],
    [0.25 + 0.45 * Math.sin(9 * seconds), 1, 0.25],
  ]),
  4: rightAlone(() => [
    [0.1, -0.12, 1],
    [0, -0.02, 1],
  ]),
  7: rightAlone(() => [
    [0.2, -0.75, 0.62],
    [0.06, 0.05, 1],
  ]),
  5: rightAlone(() => [
    [0.25, 1, 0.15],
    [0.05, 1, 0.1],
  ]),
  6: (seconds) => [
    [0.3, -0.8, 0.55],
    [-0.44 + 0.26 * Math.sin(14 * seconds), 0.12, 0.9],
  ],
};

const SEATED: Directions = [
  [0.12, -0.12, 1],
  [0.02, -1, 0.05],
];
/** A step's length, and how far a leg swings at a walk of 1.4 m/s. */
const STEP_M = 0.68;
const SWING = 0.42;

/** Of the way to a new pose each second, as a rate: a limb is there in a third of a second. */
const PACE = 9;
/** A hand that comes is met in a quarter of a second; from then on the arm follows it without delay. */
const MEETS_S = 0.25;

class Limb {
  private readonly upper: Turn;
  private readonly lower: Turn;
  private readonly end: Turn;
  private readonly rests: [Vector3, Vector3];
  private readonly stands = [new Quaternion(), new Quaternion(), new Quaternion()] as const;
  private readonly arm: Arm | undefined;
  private met = 0;
  private readonly wanted = new Quaternion();
  private readonly roll = new Quaternion();
  private readonly direction = new Vector3();

  constructor(
    [upper, lower, end]: readonly [Object3D, Object3D, Object3D],
    root: Object3D,
    private readonly side: 1 | -1,
    palm?: Palm,
  ) {
    [this.upper, this.lower, this.end] = [new Turn(upper, root), new Turn(lower, root), new Turn(end, root)];
    this.arm = palm && new Arm([upper, lower, end], palm, root, side);
    const at = (node: Object3D): Vector3 => root.worldToLocal(node.getWorldPosition(new Vector3()));
    this.rests = [at(lower).sub(at(upper)).normalize(), at(end).sub(at(lower)).normalize()];
  }

  /** Go a share of the way to these directions; back to how it was modelled without. */
  move(directions: Directions | undefined, share: number): void {
    const before = this.stands[0];
    before.slerp(this.towards(0, directions), share);
    // the lower part hangs on the upper one, and is turned with it
    const lower = directions ? this.towards(1, directions, before) : this.wanted.identity();
    if (directions?.[2]) lower.premultiply(this.roll.setFromAxisAngle(this.direction, directions[2] * this.side));
    this.stands[1].slerp(lower, share);
    this.stands[2].slerp(this.wanted.identity(), share);
    this.met = 0;
    this.set();
  }

  /** Follow a hand; says whether this limb can. */
  follow(hand: Hand, seconds: number): boolean {
    if (!this.arm) return false;
    this.met = Math.min(1, this.met + seconds / MEETS_S);
    for (const [part, wanted] of this.arm.towards(hand).entries()) this.stands[part]!.slerp(wanted, this.met);
    this.set();
    return true;
  }

  private set(): void {
    this.upper.set(this.stands[0]);
    this.lower.set(this.stands[1]);
    if (this.arm) this.end.set(this.stands[2]);
  }

  private towards(part: 0 | 1, directions: Directions | undefined, carried?: Quaternion): Quaternion {
    if (!directions) return this.wanted.identity();
    const [x, y, z] = directions[part];
    this.direction.set(x * this.side, y, z).normalize();
    if (carried) this.direction.applyQuaternion(carried.clone().invert());
    return this.wanted.setFromUnitVectors(this.rests[part], this.direction);
  }
}

/** VRM's names of what Mixamo calls otherwise; the side stands before both. */
const OF_VRM: Record<string, string> = {
  Arm: "UpperArm",
  ForeArm: "LowerArm",
  Hand: "Hand",
  HandIndex1: "IndexProximal",
  HandMiddle1: "MiddleProximal",
  HandPinky1: "LittleProximal",
  UpLeg: "UpperLeg",
  Leg: "LowerLeg",
  Foot: "Foot",
};

/** Bones by Mixamo's names, whatever stands before them; of a VRM its normalised ones, which its springs follow. */
function skeleton(root: Object3D, vrm: VRM | undefined): Map<string, Object3D> {
  const bones = new Map<string, Object3D>();
  if (!vrm) root.traverse((node) => void bones.set(node.name.replace(/^mixamorig:?/, ""), node));
  else {
    for (const [side, prefix] of [["left", "Left"], ["right", "Right"]] as const) {
      for (const [name, theirs] of Object.entries(OF_VRM)) {
        const bone = vrm.humanoid.getNormalizedBoneNode((side + theirs) as VRMHumanBoneName);
        if (bone) bones.set(prefix + name, bone);
      }
    }
  }
  return bones;
}

export class Limbs {
  /** Its bone; undefined where the body has none. */
  readonly rightHand: Object3D | undefined;
  private readonly arms: [Limb | undefined, Limb | undefined];
  private readonly legs: [Limb | undefined, Limb | undefined];
  private walked = 0;
  private time = 0;

  /** `root` faces +z, y up, at rest. */
  constructor(root: Object3D, vrm?: VRM) {
    root.updateMatrixWorld(true);
    const bones = skeleton(root, vrm);
    this.rightHand = bones.get("RightHand");
    const limb = (names: readonly string[], prefix: string, side: 1 | -1): Limb | undefined => {
      const [upper, lower, end] = names.map((name) => bones.get(prefix + name));
      const finger = (name: string): Object3D | undefined => bones.get(`${prefix}Hand${name}1`);
      const palm = names[0] === "Arm" ? { middle: finger("Middle"), index: finger("Index"), little: finger("Pinky") } : undefined;
      return upper && lower && end ? new Limb([upper, lower, end], root, side, palm) : undefined;
    };
    for (const prefix of ["Left", "Right"] as const) restFingers(bones, prefix, root);
    const pair = (...names: string[]): [Limb | undefined, Limb | undefined] => [limb(names, "Left", 1), limb(names, "Right", -1)];
    this.arms = pair("Arm", "ForeArm", "Hand");
    this.legs = pair("UpLeg", "Leg", "Foot");
  }

  /** Move on by so many seconds; `pace` is how fast the body walks forward, in metres a second. A hand goes before a gesture. */
  update(animation: number, seated: boolean, pace: number, seconds: number, hands: readonly (Hand | undefined)[] = []): void {
    this.time += seconds;
    this.walked += pace * seconds;
    const share = 1 - Math.exp(-PACE * seconds);
    const phase = (Math.PI * this.walked) / STEP_M;
    const swing = SWING * Math.min(1, Math.abs(pace));
    for (const [index, side] of ([1, -1] as const).entries()) {
      const resting = seated ? ON_THIGHS : hanging(this.time, side * swing * -0.6 * Math.sin(phase));
      const hand = hands[index];
      const follows = hand && this.arms[index]?.follow(hand, seconds);
      if (!follows) this.arms[index]?.move(ARMS[animation]?.(this.time, side) ?? resting, share);
      const leg = side * swing * Math.sin(phase);
      const bent = -swing * Math.max(0, side * Math.cos(phase));
      const walking: Directions = [
        [0.03, -1, leg],
        [0.03, -1, leg + bent],
      ];
      this.legs[index]?.move(seated ? SEATED : swing > 0.01 ? walking : undefined, share);
    }
  }
}

/** How a gesture of the head adds to it: yaw and pitch in radians at a time in seconds. */
export function headGesture(animation: number, time: number): { yaw: number; pitch: number } {
  if (animation === 2) return { yaw: 0, pitch: -0.1 + 0.14 * Math.sin(9 * time) };
  if (animation === 3) return { yaw: 0.22 * Math.sin(9 * time), pitch: 0 };
  return { yaw: 0, pitch: 0 };
}
