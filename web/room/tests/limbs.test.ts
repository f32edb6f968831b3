/** Limbs of an avatar that comes with the server: hands rest on thighs, fingers rest, clapping hands meet and do not cross. */

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";

import type { VRM } from "@pixiv/three-vrm";
import { Object3D, Vector3 } from "three";

import { Limbs } from "../figure/limbs.js";

const CLAP = 6;
const SIDES = [["Left", 1], ["Right", -1]] as const;

interface Node {
  name?: string;
  children?: number[];
  translation?: [number, number, number];
  rotation?: [number, number, number, number];
}

/** The bones of an avatar's file, without its meshes. */
async function skeleton(name: string): Promise<Object3D> {
  const file = await readFile(join(process.env["PLACES"]!, "..", "avatars", `${name}.glb`));
  const { nodes } = JSON.parse(file.subarray(20, 20 + file.readUInt32LE(12)).toString()) as { nodes: Node[] };
  const made = nodes.map((node) => {
    const bone = new Object3D();
    bone.name = node.name ?? "";
    if (node.translation) bone.position.fromArray(node.translation);
    if (node.rotation) bone.quaternion.fromArray(node.rotation);
    return bone;
  });
  for (const [index, { children = [] }] of nodes.entries()) for (const child of children) made[index]!.add(made[child]!);
  const root = new Object3D();
  root.add(...made.filter((bone) => !bone.parent));
  root.updateMatrixWorld(true);
  return root;
}

const at = (root: Object3D, name: string): Vector3 => root.getObjectByName(`mixamorig:${name}`)!.getWorldPosition(new Vector3());

/** Out of the back of a hand. */
function back(root: Object3D, side: "Left" | "Right"): Vector3 {
  const across = at(root, `${side}HandIndex1`).sub(at(root, `${side}HandPinky1`));
  const along = at(root, `${side}HandMiddle1`).sub(at(root, `${side}Hand`));
  return across.cross(along).multiplyScalar(side === "Left" ? 1 : -1).normalize();
}

for (const name of ["nora", "omar"]) {
  test(`${name}, seated: hands lie on the thighs, palms down`, async () => {
    const root = await skeleton(name);
    const limbs = new Limbs(root);
    for (let i = 0; i < 60; i++) limbs.update(0, true, 0, 1 / 30);
    root.updateMatrixWorld(true);
    for (const [side] of SIDES) {
      const [hip, knee, hand] = [at(root, `${side}UpLeg`), at(root, `${side}Leg`), at(root, `${side}HandMiddle1`)];
      const share = (hand.z - hip.z) / (knee.z - hip.z);
      assert.ok(share > 0.4 && share < 1.1, `${side}: ${share} of the thigh`);
      const on = hip.lerp(knee, share);
      assert.ok(Math.abs(hand.x - on.x) < 0.08, `${side}: beside the thigh, ${hand.x - on.x} m`);
      assert.ok(hand.y - on.y > 0.05 && hand.y - on.y < 0.17, `${side}: ${hand.y - on.y} m above the bone`);
      assert.ok(back(root, side).y > 0.6, `${side}: the palm is down`);
    }
  });

  test(`${name}: fingers close and bend to the palm, the little one most`, async () => {
    const root = await skeleton(name);
    const fingers = (): Record<string, Vector3> =>
      Object.fromEntries(
        SIDES.flatMap(([side]) =>
          ["Index", "Middle", "Ring", "Pinky"].map((finger) => [
            side + finger,
            at(root, `${side}Hand${finger}3`).sub(at(root, `${side}Hand${finger}1`)).normalize(),
          ]),
        ),
      );
    const modelled = fingers();
    new Limbs(root);
    root.updateMatrixWorld(true);
    const resting = fingers();
    for (const [side] of SIDES) {
      const lowered = (finger: string): number => modelled[side + finger]!.dot(back(root, side)) - resting[side + finger]!.dot(back(root, side));
      for (const finger of ["Index", "Middle", "Ring", "Pinky"]) assert.ok(lowered(finger) > 0.15, `${side}${finger} ${lowered(finger)}`);
      assert.ok(lowered("Pinky") > lowered("Index"));
      const spread = (all: Record<string, Vector3>): number => all[`${side}Index`]!.angleTo(all[`${side}Pinky`]!);
      assert.ok(spread(resting) < 0.8 * spread(modelled), `${spread(resting)} of ${spread(modelled)} radians`);
    }
  });

  test(`${name} claps: hands meet, and do not go through each other`, async () => {
    const root = await skeleton(name);
    const limbs = new Limbs(root);
    let [least, most] = [Infinity, 0];
    for (let i = 0; i < 120; i++) {
      limbs.update(CLAP, false, 0, 1 / 60);
      if (i < 60) continue;
      root.updateMatrixWorld(true);
      const apart = at(root, "LeftHandMiddle3").x - at(root, "RightHandMiddle3").x;
      [least, most] = [Math.min(least, apart), Math.max(most, apart)];
    }
    assert.ok(least > 0 && least < 0.05, `${least} m between the fingers`);
    assert.ok(most > 0.14, `${most} m apart`);
  });
}

test("the right hand is found by Mixamo's name with and without what stands before it, and by VRM's", async () => {
  const hand = new Object3D();
  const root = new Object3D().add(hand);
  for (const name of ["RightHand", "mixamorig:RightHand", "mixamorigRightHand"]) {
    hand.name = name;
    assert.equal(new Limbs(root).rightHand, hand);
  }
  hand.name = "J_Bip_R_Hand";
  assert.equal(new Limbs(root).rightHand, undefined);
  const humanoid = { getNormalizedBoneNode: (name: string) => (name === "rightHand" ? hand : null) };
  assert.equal(new Limbs(root, { humanoid } as unknown as VRM).rightHand, hand);
});
