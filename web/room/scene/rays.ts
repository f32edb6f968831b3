/** Finds where a ray meets a place, in pieces of a few hundred triangles: a hundred thousand one by one take milliseconds. */

import { Box3, Ray, Vector3, type BufferAttribute, type Matrix4, type Mesh } from "three";

const PIECE = 256;
/** Beyond this nothing is pointed at, in metres. */
const FAR = 60;

interface Piece {
  readonly box: Box3;
  /** Nine numbers a triangle, in the room's frame. */
  readonly corners: Float32Array;
}

export class Rays {
  private readonly pieces: Piece[];
  private readonly ray = new Ray();
  private readonly corner = [new Vector3(), new Vector3(), new Vector3()] as const;
  private readonly found = new Vector3();

  /** Takes the meshes as they stand now. */
  constructor(meshes: readonly Mesh[]) {
    this.pieces = meshes.flatMap((mesh) => cut(mesh));
  }

  hit(from: Vector3, direction: Vector3): Vector3 | undefined {
    this.ray.set(from, direction);
    let nearest = FAR;
    for (const { box, corners } of this.pieces) {
      const entered = this.ray.intersectBox(box, this.found);
      if (!entered || (entered.distanceTo(from) > nearest && !box.containsPoint(from))) continue;
      for (let at = 0; at < corners.length; at += 9) {
        const [a, b, c] = this.corner;
        a.fromArray(corners, at), b.fromArray(corners, at + 3), c.fromArray(corners, at + 6);
        const met = this.ray.intersectTriangle(a, b, c, false, this.found);
        if (met) nearest = Math.min(nearest, met.distanceTo(from));
      }
    }
    return nearest < FAR ? direction.clone().normalize().multiplyScalar(nearest).add(from) : undefined;
  }
}

function cut({ geometry, matrixWorld }: Mesh): Piece[] {
  const places = geometry.getAttribute("position");
  const index = geometry.getIndex();
  const corners = index?.count ?? places.count;
  const pieces: Piece[] = [];
  for (let start = 0; start < corners; start += 3 * PIECE) {
    const count = Math.min(3 * PIECE, corners - start);
    pieces.push(piece(places as BufferAttribute, matrixWorld, Array.from({ length: count }, (_, k) => index?.getX(start + k) ?? start + k)));
  }
  return pieces;
}

function piece(places: BufferAttribute, world: Matrix4, vertices: number[]): Piece {
  const corners = new Float32Array(3 * vertices.length);
  const box = new Box3();
  const at = new Vector3();
  for (const [k, vertex] of vertices.entries()) {
    at.fromBufferAttribute(places, vertex).applyMatrix4(world).toArray(corners, 3 * k);
    box.expandByPoint(at);
  }
  return { box, corners };
}
