/** The morph targets of a model that are called after ARKit shapes. */

import { Box3, Mesh, Vector3, type Object3D } from "three";

import { finite } from "./face.js";
import { SHAPE_INDEX, SHAPES, shapeIndex } from "./shapes.js";

interface Target {
  readonly mesh: Mesh;
  readonly index: number;
}

/** Shapes whose vertices together span brows to chin, for `faceBox`. */
const SPANNING = ["browInnerUp", "eyeBlinkLeft", "eyeBlinkRight", "jawOpen", "mouthSmileLeft", "mouthSmileRight"];
/** Of a shape's largest movement; what moves less (neck, chest) is not its place. */
const PLACE = 0.3;

export class Morphs {
  /** By shape: its targets, in however many meshes and primitives. */
  private readonly targets: readonly (readonly Target[])[];

  constructor(model: Object3D) {
    const targets: Target[][] = SHAPES.map(() => []);
    model.traverse((node) => {
      if (!(node instanceof Mesh) || !node.morphTargetDictionary || !node.morphTargetInfluences) return;
      for (const [name, index] of Object.entries(node.morphTargetDictionary)) {
        const shape = shapeIndex(name);
        if (shape !== undefined) targets[shape]!.push({ mesh: node, index });
      }
    });
    this.targets = targets;
  }

  has(shape: number): boolean {
    return this.targets[shape]!.length > 0;
  }

  set(shape: number, weight: number): void {
    for (const { mesh, index } of this.targets[shape]!) mesh.morphTargetInfluences![index] = finite(weight);
  }

  /** What the first target of a shape stands at; undefined where there is none. */
  influence(shape: number): number | undefined {
    const first = this.targets[shape]![0];
    return first?.mesh.morphTargetInfluences![first.index];
  }

  /** Mesh vertices that a shape moves by more than `PLACE` of its most. */
  *moved(shape: number): Generator<{ mesh: Mesh; vertices: number[] }> {
    for (const { mesh, index } of this.targets[shape]!) {
      const offsets = mesh.geometry.morphAttributes["position"]?.[index];
      if (!offsets) continue;
      const offset = new Vector3();
      const lengths = Float32Array.from({ length: offsets.count }, (_, vertex) =>
        offset.fromBufferAttribute(offsets, vertex).length(),
      );
      const most = lengths.reduce((a, b) => Math.max(a, b), 0);
      if (most === 0) continue;
      const vertices = [...lengths.keys()].filter((vertex) => lengths[vertex]! > PLACE * most);
      yield { mesh, vertices };
    }
  }

  /** Where the face is, in the world: what brows, lids, mouth and jaw move. Empty where there are no such targets. */
  faceBox(): Box3 {
    const box = new Box3();
    const point = new Vector3();
    for (const name of SPANNING) {
      for (const { mesh, vertices } of this.moved(SHAPE_INDEX.get(name)!)) {
        for (const vertex of vertices) box.expandByPoint(mesh.getVertexPosition(vertex, point).applyMatrix4(mesh.matrixWorld));
      }
    }
    return box;
  }
}
