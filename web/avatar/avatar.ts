/** One avatar: a model whose face, eyes and head follow a `Face`. */

import { Group, Object3D, Quaternion, type Material, type ShaderMaterial, type SkinnedMesh, Texture, Vector3 } from "three";
import { clone } from "three/addons/utils/SkeletonUtils.js";
import type { VRM } from "@pixiv/three-vrm";

import { findBone, Turn } from "./bones.js";
import { Expressions } from "./expressions.js";
import { findEyes, type Eyes } from "./eyes.js";
import { gazeOf, rotation, type Face } from "./face.js";
import { Morphs } from "./morphs.js";
import { SHAPE_INDEX, SHAPES } from "./shapes.js";

/** Of the head's turn, what the neck takes where there is one. */
const NECK_SHARE = 0.35;

const REST: Face = { weights: new Float32Array(SHAPES.length) };
const STILL = new Quaternion();

export class Avatar {
  /** Faces +z, y up, metres; place and turn it as you like. */
  readonly root = new Group();
  readonly morphs: Morphs;
  readonly expressions: Expressions | undefined;
  /** The head's joint at rest, in metres above the root; undefined where there is no head bone. */
  readonly headJoint_m: number | undefined;
  /** Turned in place of a head bone where there is none. */
  private readonly whole = new Group();
  private readonly eyes: Eyes;
  private readonly head: Turn | undefined;
  private readonly neck: Turn | undefined;
  private readonly turned = new Quaternion();
  private readonly part = new Quaternion();
  private face = REST;

  /** `model` is what the loader gave; a VRM's faces +z already. */
  constructor(
    readonly name: string,
    readonly model: Object3D,
    readonly vrm?: VRM,
  ) {
    this.root.add(this.whole.add(model));
    this.root.updateMatrixWorld(true);
    this.morphs = new Morphs(model);
    const carried = SHAPES.filter((_, shape) => this.morphs.has(shape)).length;
    this.expressions = vrm?.expressionManager ? new Expressions(vrm.expressionManager, carried) : undefined;
    this.eyes = findEyes(this.root, this.morphs, this.has(SHAPE_INDEX.get("eyeLookOutLeft")!), vrm);
    const [head, neck] = [findBone(model, "head", vrm), findBone(model, "neck", vrm)];
    this.headJoint_m = head?.getWorldPosition(new Vector3()).y;
    this.head = head ? new Turn(head, this.root) : undefined;
    this.neck = head && neck ? new Turn(neck, this.root) : undefined;
  }

  /** Whether the avatar has a shape of its own. */
  has(shape: number): boolean {
    return this.morphs.has(shape) || (this.expressions?.has(shape) ?? false);
  }

  /** What each shape that the avatar has stands at, by ARKit's name. */
  influences(): Record<string, number> {
    const found: Record<string, number> = {};
    SHAPES.forEach((name, shape) => {
      const influence = this.expressions?.influence(shape) ?? this.morphs.influence(shape);
      if (influence !== undefined) found[name] = influence;
    });
    return found;
  }

  /** What a person should know of this avatar; empty where all of a face arrives. */
  lacks(): string {
    const carried = SHAPES.filter((_, shape) => this.has(shape)).length;
    const still = [
      ...(this.head ? [] : ["no head bone, so all of it turns"]),
      ...(this.eyes.by === "nothing" ? ["no eye bones, so its eyes rest"] : []),
    ];
    if (carried === 0 && this.expressions?.presets.length) {
      still.unshift(`no ARKit shapes, so its ${this.expressions.presets.length} expressions follow roughly`);
    } else if (carried === 0) {
      still.unshift("no ARKit shapes, so its face rests");
    } else if (carried < SHAPES.length - 1) {
      still.unshift(`${carried} of the ${SHAPES.length} ARKit shapes`); // without tongueOut alone nothing is said
    }
    return still.length ? `${this.name} has ${still.join(", ")}.` : "";
  }

  /** Take over a face; `update` shows it. */
  drive(face: Face): void {
    this.face = face;
  }

  rest(): void {
    this.face = REST;
  }

  /** Once before each picture: apply the face, and let springs and constraints of a VRM move on by so many seconds. */
  update(seconds: number): void {
    this.turnHead();
    this.eyes.set(gazeOf(this.face));
    this.expressions?.set(this.face.weights);
    this.vrm?.update(seconds);
    // behind the expressions, which set what they are bound to, also where they are 0
    for (let shape = 0; shape < SHAPES.length; shape++) {
      if (!this.expressions?.has(shape)) this.morphs.set(shape, this.face.weights[shape]!);
    }
  }

  private turnHead(): void {
    const angles = this.face.head?.every(Number.isFinite) ? this.face.head : ([0, 0, 0] as const);
    rotation(...angles, this.turned);
    if (!this.head) {
      this.whole.quaternion.copy(this.turned);
      return;
    }
    this.neck?.set(this.part.slerpQuaternions(STILL, this.turned, NECK_SHARE));
    this.head.set(this.part.slerpQuaternions(STILL, this.turned, this.neck ? 1 - NECK_SHARE : 1));
  }

  /** The same avatar once more, with a face of its own; meshes and pictures are shared. Not for a VRM. */
  another(): Avatar {
    if (this.vrm) throw new TypeError("a VRM is loaded again for each person: its springs cannot be shared");
    return new Avatar(this.name, clone(this.model));
  }

  /** Free what the graphics card holds of it, and of every `another`. */
  dispose(): void {
    this.root.removeFromParent();
    release(this.root);
  }
}

/** Free what the graphics card holds of all that hangs on a node. */
export function release(root: Object3D): void {
  root.traverse((node) => {
    const { geometry, material, skeleton } = node as Partial<SkinnedMesh>;
    geometry?.dispose();
    skeleton?.dispose();
    for (const each of [material ?? []].flat() as Material[]) {
      for (const picture of picturesOf(each)) picture.dispose();
      each.dispose();
    }
  });
}

/** Pictures of a material; MToon, as other shaders, keeps its own among the uniforms. */
function picturesOf(material: Material & Partial<Pick<ShaderMaterial, "uniforms">>): Texture[] {
  const uniforms = Object.values(material.uniforms ?? {}).map(({ value }): unknown => value);
  return [...Object.values(material), ...uniforms].filter((value) => value instanceof Texture);
}
