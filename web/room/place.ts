/** Makes the meeting room by code: floor, walls, a window, a round table, light; and says where people may stand. */

import {
  AmbientLight,
  BoxGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PlaneGeometry,
  type Material,
} from "three";

/** Metres; the origin is the middle of the floor, under the table. */
const WIDTH = 9;
const DEPTH = 8;
const HEIGHT = 2.9;
const TABLE_RADIUS = 0.95;
const TABLE_HEIGHT = 0.74;
/** A body's half width: this far people keep from walls and the table. */
const BODY = 0.35;
/** Where newcomers stand. */
const CIRCLE = 1.75;
/** Beyond them the walls are near, and people stand closer. */
const RINGS = 3;
/** First across the table from each other, then between those who are there. */
const ORDER = [0, 4, 2, 6, 1, 5, 3, 7];

export function makePlace(): Group {
  const place = new Group();
  const add = (mesh: Mesh, x: number, y: number, z: number, turn = 0): Mesh => {
    mesh.position.set(x, y, z);
    mesh.rotation.y = turn;
    mesh.receiveShadow = true;
    place.add(mesh);
    return mesh;
  };
  const plain = (colour: number, roughness = 0.9): Material => new MeshStandardMaterial({ color: colour, roughness });

  const floor = add(new Mesh(new PlaneGeometry(WIDTH, DEPTH), plain(0x9a7b5c, 0.75)), 0, 0, 0);
  floor.rotation.x = -Math.PI / 2;
  for (let x = -WIDTH / 2 + 0.5; x < WIDTH / 2; x += 0.5) {
    const gap = add(new Mesh(new PlaneGeometry(0.012, DEPTH), plain(0x7d6248)), x, 0.002, 0);
    gap.rotation.x = -Math.PI / 2;
  }
  const rug = add(new Mesh(new CylinderGeometry(2.5, 2.5, 0.012, 64), plain(0x4f5d66, 1)), 0, 0.006, 0);
  rug.receiveShadow = true;
  const ceiling = add(new Mesh(new PlaneGeometry(WIDTH, DEPTH), new MeshBasicMaterial({ color: 0xd8d3ca })), 0, HEIGHT, 0);
  ceiling.rotation.x = Math.PI / 2;

  const wall = plain(0xe9e4da);
  const skirting = plain(0xf2efe8);
  for (const [x, z, turn, length] of [
    [0, -DEPTH / 2, 0, WIDTH],
    [0, DEPTH / 2, Math.PI, WIDTH],
    [-WIDTH / 2, 0, Math.PI / 2, DEPTH],
    [WIDTH / 2, 0, -Math.PI / 2, DEPTH],
  ] as const) {
    add(new Mesh(new PlaneGeometry(length, HEIGHT), wall), x, HEIGHT / 2, z, turn);
    add(new Mesh(new BoxGeometry(length, 0.12, 0.03), skirting), x, 0.06, z, turn);
  }
  // a window with an evening behind it, a board, and a door
  add(new Mesh(new BoxGeometry(3.2, 1.5, 0.06), plain(0xf2efe8)), 0, 1.65, -DEPTH / 2 + 0.02);
  add(new Mesh(new PlaneGeometry(1.48, 1.34), new MeshBasicMaterial({ color: 0xbfd6e6 })), -0.78, 1.65, -DEPTH / 2 + 0.06);
  add(new Mesh(new PlaneGeometry(1.48, 1.34), new MeshBasicMaterial({ color: 0xbfd6e6 })), 0.78, 1.65, -DEPTH / 2 + 0.06);
  add(new Mesh(new BoxGeometry(2.6, 1.4, 0.04), plain(0x39424a, 0.6)), -WIDTH / 2 + 0.02, 1.6, 0, Math.PI / 2);
  add(new Mesh(new BoxGeometry(0.95, 2.1, 0.05), plain(0x75563c, 0.6)), WIDTH / 2 - 0.02, 1.05, 2.2, -Math.PI / 2);

  const top = add(new Mesh(new CylinderGeometry(TABLE_RADIUS, TABLE_RADIUS, 0.04, 64), plain(0xb78b5e, 0.5)), 0, TABLE_HEIGHT, 0);
  const foot = add(new Mesh(new CylinderGeometry(0.07, 0.3, TABLE_HEIGHT, 32), plain(0x3a3f44, 0.5)), 0, TABLE_HEIGHT / 2, 0);
  for (const mesh of [top, foot]) mesh.castShadow = true;

  place.add(new AmbientLight(0xffffff, 0.35));
  place.add(new HemisphereLight(0xfdf6ea, 0xb0a08a, 2.1));
  const sun = new DirectionalLight(0xfff0dc, 1.5);
  sun.position.set(1.8, 2.8, 2.4);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  Object.assign(sun.shadow.camera, { left: -4, right: 4, top: 4, bottom: -4, far: 10 });
  sun.shadow.bias = -0.002;
  place.add(sun);
  const window_ = new DirectionalLight(0xdfeaff, 0.9);
  window_.position.set(0, 1.7, -4);
  place.add(window_);
  return place;
}

export const BACKGROUND = new Color(0xd9d4c9);

/**
 * Where a newcomer stands: the first place around the table, then around those, that is free; looking at its middle.
 *
 * Who looks at a replay begins with the second `ring`: people of a recording come to the first whoever stands there.
 */
export function freePlace(taken: readonly (readonly [number, number])[], ring = 0): { x: number; z: number; heading: number } {
  for (; ; ring++) {
    for (const order of ORDER) {
      const turn = ((order + ring / 2) / ORDER.length) * 2 * Math.PI;
      const radius = CIRCLE + ring * 2 * BODY;
      const [x, z] = allowed(radius * Math.sin(turn), radius * Math.cos(turn));
      const free = taken.every(([otherX, otherZ]) => Math.hypot(x - otherX, z - otherZ) >= 2 * BODY);
      if (free || ring === RINGS) return { x, z, heading: Math.atan2(-x, -z) };
    }
  }
}

/** The nearest place where a body may stand. */
export function allowed(x: number, z: number): [number, number] {
  x = Math.min(Math.max(x, BODY - WIDTH / 2), WIDTH / 2 - BODY);
  z = Math.min(Math.max(z, BODY - DEPTH / 2), DEPTH / 2 - BODY);
  const [distance, least] = [Math.hypot(x, z), TABLE_RADIUS + BODY];
  if (distance >= least) return [x, z];
  return distance > 0 ? [(x / distance) * least, (z / distance) * least] : [0, least];
}
