/** Lets one arm of a skeleton reach for a hand: shoulder, elbow and wrist, from how they stand at rest. */

import { Quaternion, Vector3, type Object3D } from "three";

import { bend, facing, hinge, twist, type Hand } from "./reach.js";

/** Of a hand's roll, what the lower arm takes: skin would wring at the wrist. */
const FOREARM_SHARE = 0.5;
const STILL = new Quaternion();

/** First bones of fingers by which a palm is known; without them the hand goes on as its lower arm does. */
export interface Palm {
  readonly middle: Object3D | undefined;
  readonly index: Object3D | undefined;
  readonly little: Object3D | undefined;
}

/** Three rotations from rest, each within the one before it. */
export type Turns = readonly [upper: Quaternion, lower: Quaternion, hand: Quaternion];

export class Arm {
  private readonly shoulder: Vector3;
  private readonly upperM: number;
  private readonly lowerM: number;
  private readonly lowerRest: Vector3;
  private readonly upperFrom: Quaternion;
  private readonly lowerFrom: Quaternion;
  private readonly handFrom: Quaternion;

  /** `root` faces +z, y up, at rest. */
  constructor([upper, lower, hand]: readonly [Object3D, Object3D, Object3D], palm: Palm, root: Object3D, private readonly side: 1 | -1) {
    const at = (node: Object3D): Vector3 => root.worldToLocal(node.getWorldPosition(new Vector3()));
    this.shoulder = at(upper);
    const upperRest = at(lower).sub(this.shoulder);
    this.lowerRest = at(hand).sub(at(lower));
    [this.upperM, this.lowerM] = [upperRest.length(), this.lowerRest.length()];
    upperRest.normalize();
    this.lowerRest.normalize();
    const axis = hinge(upperRest, side);
    this.upperFrom = facing(upperRest, axis).invert();
    this.lowerFrom = facing(this.lowerRest, axis).invert();
    const fingers = palm.middle ? at(palm.middle).sub(at(hand)).normalize() : this.lowerRest.clone();
    // seen from its back, with the fingers ahead, a left hand's index is at the right
    const back =
      palm.index && palm.little
        ? at(palm.index).sub(at(palm.little)).cross(fingers).multiplyScalar(side)
        : new Vector3(side, 1, 0); // at a right angle to an arm that hangs, or that is spread as far as skeletons are
    this.handFrom = facing(fingers, back).invert();
  }

  /** How to stand so that the wrist is at a hand, as near as the arm reaches. */
  towards({ at, turn }: Hand): Turns {
    const bent = bend(at.clone().sub(this.shoulder), this.upperM, this.lowerM, this.side);
    const upper = facing(bent.upper, bent.hinge).multiply(this.upperFrom);
    const carried = facing(bent.lower, bent.hinge).multiply(this.lowerFrom);
    const hand = facing(new Vector3(0, 0, 1).applyQuaternion(turn), new Vector3(0, 1, 0).applyQuaternion(turn)).multiply(this.handFrom);
    const roll = twist(carried.clone().invert().multiply(hand), this.lowerRest);
    carried.multiply(roll.slerpQuaternions(STILL, roll.clone(), FOREARM_SHARE));
    hand.premultiply(carried.clone().invert());
    return [upper, carried.premultiply(upper.clone().invert()), hand];
  }
}
