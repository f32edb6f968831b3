/** Turns an avatar's eyes: by VRM's look-at, by bones, or by nothing where morph targets do it already. */

import { MathUtils, Quaternion, SkinnedMesh, type Mesh, type Object3D } from "three";
import type { VRM } from "@pixiv/three-vrm";

import { findBone, Turn } from "./bones.js";
import { rotation } from "./face.js";
import type { Morphs } from "./morphs.js";
import { SHAPE_INDEX } from "./shapes.js";

type Gaze = readonly [number, number, number, number];

export interface Eyes {
  readonly by: "look-at" | "bones" | "morphs" | "nothing";
  set(gaze: Gaze): void;
}

/**
 * The one thing that turns an avatar's eyes.
 *
 * Some avatars have eye bones, and eyeLook targets that turn the same eyeballs: those are left to the targets, or they would
 * turn twice. Where the targets move lids alone, bones and targets work together.
 */
export function findEyes(root: Object3D, morphs: Morphs, hasLooks: boolean, vrm?: VRM): Eyes {
  const applier = vrm?.lookAt?.applier;
  if (vrm && applier && !(hasLooks && !("humanoid" in applier))) return new LookAt(vrm);
  const left = findBone(root, "leftEye", vrm);
  const right = findBone(root, "rightEye", vrm);
  if (left && right && !targetsTurn(left, "Left", morphs) && !targetsTurn(right, "Right", morphs)) {
    return new EyeBones(new Turn(left, root), new Turn(right, root));
  }
  return { by: hasLooks ? "morphs" : "nothing", set: () => undefined };
}

/** VRM says by itself how far its eyes go for an angle; both look the same way. */
class LookAt implements Eyes {
  readonly by = "look-at";

  constructor(private readonly vrm: VRM) {}

  set([leftYaw, leftPitch, rightYaw, rightPitch]: Gaze): void {
    const lookAt = this.vrm.lookAt!;
    lookAt.yaw = MathUtils.radToDeg((leftYaw + rightYaw) / 2);
    lookAt.pitch = -MathUtils.radToDeg((leftPitch + rightPitch) / 2); // VRM's goes downwards
  }
}

class EyeBones implements Eyes {
  readonly by = "bones";
  private readonly turned = new Quaternion();

  constructor(
    private readonly left: Turn,
    private readonly right: Turn,
  ) {}

  set([leftYaw, leftPitch, rightYaw, rightPitch]: Gaze): void {
    this.left.set(rotation(leftYaw, leftPitch, 0, this.turned));
    this.right.set(rotation(rightYaw, rightPitch, 0, this.turned));
  }
}

/** Whether a look to the side moves what hangs on the eye's bone. */
function targetsTurn(bone: Object3D, side: "Left" | "Right", morphs: Morphs): boolean {
  for (const { mesh, vertices } of morphs.moved(SHAPE_INDEX.get(`eyeLookOut${side}`)!)) {
    if (hangsOn(mesh, bone)) return true;
    if (mesh instanceof SkinnedMesh && vertices.some((vertex) => mostlyOn(mesh, vertex, bone))) return true;
  }
  return false;
}

function hangsOn(mesh: Mesh, bone: Object3D): boolean {
  for (let node: Object3D | null = mesh; node; node = node.parent) if (node === bone) return true;
  return false;
}

function mostlyOn(mesh: SkinnedMesh, vertex: number, bone: Object3D): boolean {
  const joints = mesh.geometry.getAttribute("skinIndex");
  const shares = mesh.geometry.getAttribute("skinWeight");
  return [0, 1, 2, 3].some(
    (slot) =>
      shares.getComponent(vertex, slot) > 0.5 && mesh.skeleton.bones[joints.getComponent(vertex, slot)] === bone,
  );
}
