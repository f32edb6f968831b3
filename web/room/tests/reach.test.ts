/** Arms reach, within what they are; elbows bend as people's do; a hand's rotation arrives at the hand. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { Object3D, Quaternion, Vector3 } from "three";

import { Limbs } from "../figure/limbs.js";
import { bend } from "../figure/reach.js";

const [UPPER_M, LOWER_M] = [0.28, 0.25];
const SIDES = [1, -1] as const;
const vector = (x: number, y: number, z: number): Vector3 => new Vector3(x, y, z);

/** Directions all around, evenly (a Fibonacci lattice). */
function* around(count: number): Generator<Vector3> {
  for (let i = 0; i < count; i++) {
    const y = 1 - (2 * i + 1) / count;
    const angle = i * Math.PI * (3 - Math.sqrt(5));
    yield vector(Math.cos(angle) * Math.sqrt(1 - y * y), y, Math.sin(angle) * Math.sqrt(1 - y * y));
  }
}

test("a wrist is where the hand is wherever it can be, and else as near as the arm reaches", () => {
  const least = Math.hypot(UPPER_M - LOWER_M * Math.cos(Math.PI / 6), LOWER_M * 0.5);
  for (const side of SIDES) {
    for (const way of around(400)) {
      for (const far of [0, 0.1, 0.2, 0.3, 0.45, 0.529, 0.6, 5]) {
        const { upper, lower, hinge } = bend(way.clone().multiplyScalar(far), UPPER_M, LOWER_M, side);
        for (const unit of [upper, lower, hinge]) assert.ok(Math.abs(unit.length() - 1) < 1e-9);
        const wrist = upper.clone().multiplyScalar(UPPER_M).addScaledVector(lower, LOWER_M);
        const held = Math.min(Math.max(far, least), 0.999 * (UPPER_M + LOWER_M));
        const wanted = (far ? way : vector(0, 0, 1)).clone().multiplyScalar(held);
        assert.ok(wrist.distanceTo(wanted) < 1e-9, `${far} m to ${way.toArray()}`);
        assert.ok(upper.dot(lower) > -Math.cos(Math.PI / 6) - 1e-9, "no further than 150 degrees");
        assert.ok(hinge.dot(upper.clone().cross(lower)) < 1e-12, "always to the same side, never backwards");
      }
    }
  }
});

/** Where the elbow lies beside the line from shoulder to wrist. */
function elbow(x: number, y: number, z: number, side: 1 | -1): Vector3 {
  const offset = vector(x * side, y, z);
  const { upper } = bend(offset, UPPER_M, LOWER_M, side);
  const along = offset.normalize();
  const off = upper.addScaledVector(along, -upper.dot(along));
  return off.setX(off.x * side);
}

for (const [name, [x, y, z], right] of [
  ["ahead: down, a little out", [0, 0, 0.4], (e: Vector3) => e.y < -0.1 && e.x > 0],
  ["hanging: behind, a little out", [0.05, -0.4, 0.05], (e: Vector3) => e.z < -0.1 && e.x > 0],
  ["raised: forward, a little out", [0.05, 0.4, 0], (e: Vector3) => e.z > 0.1 && e.x > 0],
  ["spread: down and behind", [0.4, 0, 0], (e: Vector3) => e.y < -0.1 && e.z < 0],
  ["at the other shoulder: down, before the chest", [-0.25, 0, 0.25], (e: Vector3) => e.y < -0.1],
  ["at the chin: down and out", [-0.12, 0.1, 0.2], (e: Vector3) => e.y < -0.05 && e.x > 0],
  ["on a table: down, out or behind", [0, -0.25, 0.35], (e: Vector3) => e.y < -0.05 && e.z < 0],
] as const) {
  test(`an elbow of a hand ${name}`, () => {
    for (const side of SIDES) assert.ok(right(elbow(x, y, z, side)), JSON.stringify(elbow(x, y, z, side)));
  });
}

test("an elbow goes on smoothly, but straight behind", () => {
  for (const side of SIDES) {
    for (const way of around(400)) {
      if (way.z < -0.9) continue;
      const beside = way.clone().applyAxisAngle(vector(0.36, 0.48, 0.8), 0.01);
      const [a, b] = [way, beside].map((at) => bend(at.clone().multiplyScalar(0.4), UPPER_M, LOWER_M, side).upper);
      assert.ok(a!.angleTo(b!) < 0.06, `${a!.angleTo(b!)} at ${way.toArray()}`);
    }
  }
});

/** Arms of Mixamo's names, that hang at 45 degrees with their palms inwards; its bones have rests of their own. */
function skeleton(): { root: Object3D; bones: Record<string, Object3D> } {
  const root = new Object3D();
  const bones: Record<string, Object3D> = {};
  const put = (name: string, parent: Object3D, x: number, y: number, z: number): void => {
    const bone = new Object3D();
    bone.name = `mixamorig${name}`;
    bone.rotation.set(0.3 * x + 0.1, -0.4, 0.7 * y); // any rest
    parent.add(bone);
    root.updateMatrixWorld(true);
    bone.position.copy(parent.worldToLocal(vector(x, y, z)));
    root.updateMatrixWorld(true);
    bones[name] = bone;
  };
  for (const [name, side] of [["Left", 1], ["Right", -1]] as const) {
    put(`${name}Arm`, root, 0.18 * side, 1.4, 0);
    put(`${name}ForeArm`, bones[`${name}Arm`]!, 0.36 * side, 1.2, -0.02);
    put(`${name}Hand`, bones[`${name}ForeArm`]!, 0.53 * side, 1.02, 0.02);
    put(`${name}HandMiddle1`, bones[`${name}Hand`]!, 0.59 * side, 0.96, 0.03);
    put(`${name}HandIndex1`, bones[`${name}Hand`]!, 0.59 * side, 0.965, 0.055);
    put(`${name}HandPinky1`, bones[`${name}Hand`]!, 0.58 * side, 0.955, -0.015);
  }
  return { root, bones };
}

const at = (bone: Object3D): Vector3 => bone.getWorldPosition(vector(0, 0, 0));

test("a skeleton's wrist, fingers and back of the hand are where the hand is, and go back to hang", () => {
  const { root, bones } = skeleton();
  const limbs = new Limbs(root);
  const hang = (): void => {
    for (let i = 0; i < 60; i++) limbs.update(0, false, 0, 1 / 30, []);
    root.updateMatrixWorld(true);
  };
  hang();
  const idle = SIDES.map((_, index) => at(bones[`${["Left", "Right"][index]}Hand`]!));
  const turn = new Quaternion().setFromUnitVectors(vector(0, 0, 1), vector(0.4, 0.3, 0.866).normalize());
  const wanted = SIDES.map((side) => ({ at: vector(0.1 * side, 1.2, 0.35), turn }));
  let least = Infinity;
  for (let i = 0; i < 30; i++) {
    limbs.update(1, false, 0, 1 / 30, wanted);
    root.updateMatrixWorld(true);
    if (i === 0) least = at(bones["LeftHand"]!).distanceTo(wanted[0]!.at);
  }
  assert.ok(least > 0.05, "a hand that comes is met smoothly");
  for (const [index, name] of ["Left", "Right"].entries()) {
    const hand = at(bones[`${name}Hand`]!);
    assert.ok(hand.distanceTo(wanted[index]!.at) < 1e-4, `${name}: ${hand.toArray()}`);
    const fingers = at(bones[`${name}HandMiddle1`]!).sub(hand).normalize();
    assert.ok(fingers.angleTo(vector(0, 0, 1).applyQuaternion(turn)) < 1e-4);
    const across = at(bones[`${name}HandIndex1`]!).sub(at(bones[`${name}HandPinky1`]!));
    const back = across.cross(fingers).multiplyScalar(SIDES[index]!).normalize();
    assert.ok(back.angleTo(vector(0, 1, 0).applyQuaternion(turn)) < 1e-4, `${name}: back ${back.toArray()}`);
  }
  limbs.update(0, false, 0, 1 / 30, [wanted[0], undefined]);
  root.updateMatrixWorld(true);
  assert.ok(at(bones["LeftHand"]!).distanceTo(wanted[0]!.at) < 1e-4, "one hand goes on without the other");
  assert.ok(at(bones["RightHand"]!).distanceTo(wanted[1]!.at) > 0.01);
  hang();
  for (const [index, name] of ["Left", "Right"].entries()) {
    assert.ok(at(bones[`${name}Hand`]!).distanceTo(idle[index]!) < 0.02, name);
  }
});
