/** Newcomers stand beside each other, inside the room, and not in the table. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { allowed, freePlace } from "../place.js";

test("twenty people who come one by one all have room", () => {
  const taken: [number, number][] = [];
  for (let person = 0; person < 20; person++) {
    const { x, z, heading } = freePlace(taken);
    assert.deepEqual(allowed(x, z), [x, z]);
    for (const [otherX, otherZ] of taken) assert.ok(Math.hypot(x - otherX, z - otherZ) >= 0.69, `person ${person}`);
    // ahead of them is the table
    assert.ok(Math.hypot(x + Math.sin(heading) * Math.hypot(x, z), z + Math.cos(heading) * Math.hypot(x, z)) < 1e-9);
    taken.push([x, z]);
  }
});

test("who looks at a replay stands behind the first eight, whoever comes later", () => {
  const table: [number, number][] = [];
  for (let person = 0; person < 8; person++) {
    const { x, z } = freePlace(table);
    table.push([x, z]);
  }
  const { x, z } = freePlace([], 1);
  for (const [otherX, otherZ] of table) assert.ok(Math.hypot(x - otherX, z - otherZ) >= 0.69);
});

test("a hundred people are placed as well", () => {
  const taken: [number, number][] = [];
  for (let person = 0; person < 100; person++) {
    const { x, z } = freePlace(taken);
    taken.push([x, z]);
  }
});

test("nobody walks through walls or the table", () => {
  for (let x = -20; x <= 20; x += 0.7) {
    for (let z = -20; z <= 20; z += 0.7) {
      const [nearX, nearZ] = allowed(x, z);
      assert.ok(Math.hypot(nearX, nearZ) >= 1.299 && Math.abs(nearX) <= 4.151 && Math.abs(nearZ) <= 3.651, `${x} ${z}`);
    }
  }
  assert.deepEqual(allowed(0, 0), [0, 1.2999999999999998]);
});
