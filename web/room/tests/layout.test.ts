/** Newcomers stand beside each other, inside a place, and in nothing that stands there; in both places of the server. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { Layout, type NamedNode } from "../scene/layout.js";

/** Nodes of a .glb file, of which those with names stand at the top. */
function nodesOf(name: string): NamedNode[] {
  const content = readFileSync(`${process.env["PLACES"]}/${name}.glb`);
  const { nodes } = JSON.parse(content.subarray(20, 20 + content.readUInt32LE(12)).toString("utf8"));
  return nodes.map(({ name, translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }: Record<string, number[]> & { name: string }) => ({
    name,
    x: translation[0],
    z: translation[2],
    heading: 2 * Math.atan2(rotation[1]!, rotation[3]!),
    scale: [scale[0], scale[2]],
  }));
}

for (const name of ["meeting", "operating"]) {
  const nodes = nodesOf(name);
  const layout = new Layout(nodes);
  const named = (word: string): NamedNode[] => nodes.filter((node) => node.name.startsWith(`${word}.`));

  test(`${name}: it has places, seats and a screen`, () => {
    assert.ok(named("place").length >= 12 && named("seat").length >= 3 && named("screen").length === 1);
  });

  test(`${name}: who stands at a place stands in nothing`, () => {
    for (const { name, x, z } of named("place")) {
      const [nearX, nearZ] = layout.allowed(x, z);
      assert.ok(Math.hypot(nearX - x, nearZ - z) < 1e-9, name);
    }
  });

  test(`${name}: forty people who come one by one all have room`, () => {
    const taken: [number, number][] = [];
    for (let person = 0; person < 40; person++) {
      const { x, z } = layout.freePlace(taken);
      const [nearX, nearZ] = layout.allowed(x, z);
      assert.ok(Math.hypot(nearX - x, nearZ - z) < 1e-9);
      for (const [otherX, otherZ] of taken) assert.ok(Math.hypot(x - otherX, z - otherZ) >= 0.7 - 1e-9, `person ${person}`);
      taken.push([x, z]);
    }
  });

  test(`${name}: the first come to the first place, and look where it looks`, () => {
    const first = named("place").sort((a, b) => (a.name < b.name ? -1 : 1))[0]!;
    const { x, z, heading } = layout.freePlace([]);
    assert.deepEqual([x, z, heading], [first.x, first.z, first.heading]);
  });

  test(`${name}: who looks at a replay leaves the places to the recorded`, () => {
    const { x, z } = layout.freePlace([], true);
    for (const place of named("place")) assert.ok(Math.hypot(x - place.x, z - place.z) >= 0.7, place.name);
  });

  test(`${name}: a thousand people are placed as well`, () => {
    const taken: [number, number][] = [];
    for (let person = 0; person < 300; person++) {
      const { x, z } = layout.freePlace(taken);
      taken.push([x, z]);
    }
    assert.ok(taken.every(([x, z]) => Number.isFinite(x) && Number.isFinite(z)));
  });

  test(`${name}: nobody ends in what stands there, wherever they are pushed`, () => {
    const walk = nodes.find((node) => node.name === "walk")!;
    for (let x = -12; x <= 12; x += 0.53) {
      for (let z = -12; z <= 12; z += 0.53) {
        const [nearX, nearZ] = layout.allowed(x, z);
        assert.ok(Math.abs(nearX) <= walk.scale[0] && Math.abs(nearZ) <= walk.scale[1], `${x} ${z}`);
        for (const block of named("block")) {
          const [sin, cos] = [Math.sin(block.heading), Math.cos(block.heading)];
          const [u, v] = [(nearX - block.x) * cos - (nearZ - block.z) * sin, (nearX - block.x) * sin + (nearZ - block.z) * cos];
          const inside = Math.abs(u) < block.scale[0] - 1e-6 && Math.abs(v) < block.scale[1] - 1e-6;
          assert.ok(!inside, `${x} ${z} ends in ${block.name}`);
        }
      }
    }
  });

  test(`${name}: a seat is taken once, and only from near`, () => {
    const seat = named("seat")[0]!;
    const near = layout.freeSeat(seat.x + 0.4, seat.z, []);
    assert.ok(near && Math.hypot(near.x - seat.x, near.z - seat.z) < 1e-9);
    assert.notDeepEqual(layout.freeSeat(seat.x, seat.z, [[seat.x, seat.z]]), near);
    assert.equal(layout.freeSeat(50, 50, []), undefined);
  });
}

test("a place without any name has room for people all the same", () => {
  const layout = new Layout([]);
  const { x, z } = layout.freePlace([[0, 0]]);
  assert.ok(Math.hypot(x, z) >= 0.7);
  assert.deepEqual(layout.allowed(99, 0), [3.65, 0]);
});
