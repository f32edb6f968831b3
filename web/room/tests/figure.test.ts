/** A head on the simple body goes where its person's head is, and never off its neck. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { Vector3 } from "three";

import { Avatar } from "../../avatar/index.js";
import { plainHead } from "../figure/body.js";
import { Figure } from "../figure/figure.js";
import { REST } from "../line/protocol.js";

/** How far the head and the body under it are from where they rest, once this came. */
function moved(head_m: readonly [number, number, number]): { head: number[]; apart: number } {
  const avatar = new Avatar("plain", plainHead());
  const figure = new Figure(avatar, 1, 0.3);
  figure.show({ ...REST, head_m }, 0.03, new Vector3());
  const body = avatar.root.parent!.children.find((node) => node !== avatar.root && node.children.length > 0)!;
  return { head: avatar.root.position.toArray(), apart: avatar.root.position.distanceTo(body.position) };
}

test("a small move is the head's alone", () => {
  const { head, apart } = moved([0.05, 0, 0]);
  assert.deepEqual(head, [0.05, 0, 0]);
  assert.ok(Math.abs(apart - 0.05) < 1e-9);
});

test("of a large one the body comes along, a neck's length behind", () => {
  const { head, apart } = moved([0.6, -0.4, 0.2]);
  assert.deepEqual(head, [0.6, -0.4, 0.2]);
  assert.ok(Math.abs(apart - 0.08) < 1e-9);
});
