/** Rays and dots go with whoever pointed, and with the meeting. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Scene, Vector3, type Mesh } from "three";

import type { Figure } from "../figure/figure.js";
import { POINTER, type Message } from "../line/protocol.js";
import type { Place } from "../scene/place.js";
import { Pointers } from "../scene/pointers.js";

test("nothing of a pointer stays, on the graphics card neither", () => {
  const scene = new Scene();
  const pointers = new Pointers(scene, { hit: () => new Vector3(0, 1, 2) } as unknown as Place);
  const message = { animation: POINTER, flags: 0, floor_m: [0, 0], heading: 0, rotation: [0, 0, 0, 1] } as unknown as Message;
  const figure = { hand: (at: Vector3) => at.set(0, 1, 0) } as unknown as Figure;
  for (const number of [1, 2]) pointers.show(number, message, figure, new Vector3(), false);
  assert.equal(scene.children.length, 4);
  const held = new Set(scene.children.flatMap((node) => [(node as Mesh).geometry, (node as Mesh).material]).flat());
  for (const one of held) one.addEventListener("dispose", () => held.delete(one));
  pointers.clear();
  assert.equal(scene.children.length, 0);
  assert.equal(held.size, 0);
});
