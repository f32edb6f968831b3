/** Finds an avatar's head, neck and eyes, and turns a bone as a head or an eye is turned. */

import { Quaternion, type Object3D } from "three";
import type { VRM } from "@pixiv/three-vrm";

export type BoneName = "head" | "neck" | "leftEye" | "rightEye";

/** The words of a bone's name, once what tools put around them is gone. */
const WANTED: Record<BoneName, string> = { head: "head", neck: "neck", leftEye: "eye left", rightEye: "eye right" };
const AROUND = new Set(["mixamorig", "cc", "base", "bip", "def", "bone", "joint", "jnt", "bind", "ball", "b", "j", "adj", "faceeye"]);
const SIDES: Record<string, string> = { l: "left", r: "right" };

function words(name: string): string {
  return name
    .replace(/([a-z])([A-Z])/g, "$1 $2")
    .replace(/eyeball/gi, "eye")
    .toLowerCase()
    .split(/[^a-z]+/)
    .filter((word) => word && !AROUND.has(word))
    .map((word) => SIDES[word] ?? word)
    .sort()
    .join(" ");
}

/**
 * A bone by VRM's name, or by the words of its own: `Head`, `mixamorig:LeftEye`, `eye.L`, `CC_Base_R_Eye`.
 *
 * In a VRM it is the normalised bone: what body animations set, and what springs see.
 */
export function findBone(model: Object3D, name: BoneName, vrm?: VRM): Object3D | undefined {
  if (vrm) return vrm.humanoid.getNormalizedBoneNode(name) ?? undefined;
  let found: Object3D | undefined;
  model.traverse((node) => {
    if (words(node.name) !== WANTED[name]) return;
    // a joint before a mesh of the same name
    if (!found || ("isBone" in node && !("isBone" in found))) found = node;
  });
  return found;
}

/** A bone, and how it stood at rest. */
export class Turn {
  private readonly above: Quaternion;
  private readonly aboveInverse: Quaternion;
  private readonly atRest: Quaternion;

  /** `root` faces +z with y up; whatever moves it or stands above it does not count. */
  constructor(
    private readonly bone: Object3D,
    root: Object3D,
  ) {
    this.above = new Quaternion();
    for (let node = bone.parent; node && node !== root; node = node.parent) this.above.premultiply(node.quaternion);
    this.aboveInverse = this.above.clone().invert();
    this.atRest = bone.quaternion.clone();
  }

  /** Set the bone to its rest, turned by a rotation of the root's frame. */
  set(rotation: Quaternion): void {
    this.bone.quaternion.copy(this.aboveInverse).multiply(rotation).multiply(this.above).multiply(this.atRest);
  }
}
