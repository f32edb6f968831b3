/** A ray meets the nearest triangle, as three.js itself finds it. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Mesh, Raycaster, SphereGeometry, TorusKnotGeometry, Vector3 } from "three";

import { Rays } from "../scene/rays.js";

const knot = new Mesh(new TorusKnotGeometry(1, 0.3, 128, 24));
knot.position.set(0.5, 1, -2);
knot.rotation.set(0.3, 0.7, 0.1);
const ball = new Mesh(new SphereGeometry(0.4, 40, 30));
ball.position.set(-0.5, 1.2, 0);
const meshes = [knot, ball];
for (const mesh of meshes) {
  mesh.updateMatrixWorld(true);
  (mesh.material as { side: number }).side = 2;
}

test("two hundred rays end where three.js says", () => {
  const rays = new Rays(meshes);
  let met = 0;
  for (let k = 0; k < 200; k++) {
    const from = new Vector3(3 * Math.sin(k), 1 + Math.cos(2 * k), 3 * Math.cos(k));
    const towards = new Vector3(Math.sin(5 * k), 1 + 0.5 * Math.cos(7 * k), -2 * Math.abs(Math.sin(3 * k))).sub(from).normalize();
    const expected = new Raycaster(from, towards).intersectObjects(meshes)[0]?.point;
    const found = rays.hit(from, towards);
    assert.equal(found === undefined, expected === undefined, `ray ${k}`);
    if (!expected) continue;
    met++;
    assert.ok(found!.distanceTo(expected) < 1e-4, `ray ${k}`);
  }
  assert.ok(met > 60, `${met}`);
});

test("an empty place is met nowhere", () => {
  assert.equal(new Rays([]).hit(new Vector3(), new Vector3(0, 0, 1)), undefined);
});
