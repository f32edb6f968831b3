/** Whoever leaves takes along what the graphics card held for them. */

import { strict as assert } from "node:assert";
import { test } from "node:test";
import { Bone, Mesh, Scene, Skeleton, SkinnedMesh, Sprite, type BufferGeometry, type Material } from "three";

import { Avatar } from "../../avatar/avatar.js";
import { Figure } from "../figure/figure.js";
import type { Person } from "../line/texts.js";
import { PLAIN } from "../people/avatars.js";
import type { Brought } from "../people/brought.js";
import { People } from "../people/people.js";

const ADA = { number: 7, name: "Ada", avatar: PLAIN, own: "", id: "0".repeat(16), present: true } as unknown as Person;

test("of who has left no geometry and no material stays", () => {
  const scene = new Scene();
  const people = new People({ scene, hide: () => undefined }, { wears: () => undefined } as unknown as Brought);
  people.meet(ADA);
  const held = new Set<BufferGeometry | Material>();
  scene.traverse((node) => {
    if (!(node instanceof Mesh || node instanceof Sprite)) return;
    held.add(node.material as Material);
    if (node instanceof Mesh) held.add(node.geometry as BufferGeometry); // sprites share one
  });
  assert.ok(held.size > 20, `a head and a body hold ${held.size} things`);
  for (const one of held) (one as Material).addEventListener("dispose", () => held.delete(one));
  people.part(ADA.number);
  assert.deepEqual([...held].map((one) => one.type), []);
  assert.equal(scene.children.length, 0);
});

test("the bones of one who wears a shared avatar are freed, and its meshes are not", () => {
  const mesh = new SkinnedMesh();
  const bone = new Bone();
  mesh.add(bone);
  mesh.bind(new Skeleton([bone]));
  mesh.skeleton.computeBoneTexture();
  const freed: string[] = [];
  mesh.skeleton.boneTexture!.addEventListener("dispose", () => freed.push("bones"));
  mesh.geometry.addEventListener("dispose", () => freed.push("geometry"));
  new Figure(new Avatar("shared", mesh), 1, 1.7).dispose();
  assert.deepEqual(freed, ["bones"]);
});
