/** A simple body under a head: chest, neck, and arms that make gestures; and a head made by code for who has no other. */

import {
  CapsuleGeometry,
  CylinderGeometry,
  Float32BufferAttribute,
  Group,
  LatheGeometry,
  Mesh,
  MeshStandardMaterial,
  SphereGeometry,
  Vector2,
} from "three";

import { clothesOf } from "./colours.js";

/** Height of the eyes above the floor, standing and seated, in metres. */
export const EYES_M = 1.6;
export const SEATED_M = 1.18;

/** Half profile of chest and neck from the eyes' height downwards: metres from the middle, metres below the eyes. */
const PROFILE: readonly [number, number][] = [
  [0.058, -0.14],
  [0.085, -0.155],
  [0.14, -0.18],
  [0.185, -0.215],
  [0.203, -0.27],
  [0.2, -0.4],
  [0.178, -0.58],
  [0.168, -0.75],
  [0.178, -0.88],
  [0.172, -0.95],
  [0, -0.97],
];
const SHOULDER = { x: 0.205, y: -0.25 };
/** The middle of neck and chest lies so far behind the eyes. */
const BEHIND = -0.085;
const UPPER = 0.27;
const LOWER = 0.25;

/** An arm that hangs; its parts are called as Mixamo's bones, so that `Limbs` moves it like a skeleton's. */
function makeArm(side: "Left" | "Right", cloth: MeshStandardMaterial, skin: MeshStandardMaterial): Group {
  const arm = new Group();
  arm.name = `${side}Arm`;
  arm.position.set(side === "Left" ? SHOULDER.x : -SHOULDER.x, SHOULDER.y, BEHIND);
  const upper = new Mesh(new CapsuleGeometry(0.048, UPPER - 0.05, 6, 12), cloth);
  upper.position.y = -UPPER / 2;
  const elbow = new Group();
  elbow.name = `${side}ForeArm`;
  elbow.position.y = -UPPER;
  const lower = new Mesh(new CapsuleGeometry(0.04, LOWER - 0.06, 6, 12), cloth);
  lower.position.y = -LOWER / 2;
  const hand = new Mesh(new SphereGeometry(0.05, 16, 12), skin);
  hand.name = `${side}Hand`;
  hand.scale.set(0.7, 1.25, 0.9);
  hand.position.y = -LOWER - 0.05;
  arm.add(upper, elbow.add(lower, hand));
  return arm;
}

/** Chest, neck and arms; the origin lies between the eyes. */
export function makeBody(number: number): Group {
  const body = new Group();
  const cloth = new MeshStandardMaterial({ color: clothesOf(number), roughness: 0.95 });
  const skin = new MeshStandardMaterial({ color: 0xb98a6c, roughness: 0.7 });
  const points = PROFILE.map(([radius, y]) => new Vector2(radius, y)).reverse();
  const chest = new Mesh(new LatheGeometry(points, 32), cloth);
  chest.scale.z = 0.62;
  chest.position.z = BEHIND;
  const neck = new Mesh(new CylinderGeometry(0.05, 0.058, 0.12, 24), skin);
  neck.position.set(0, -0.12, BEHIND);
  body.add(chest, neck, makeArm("Left", cloth, skin), makeArm("Right", cloth, skin));
  body.traverse((node) => void (node.castShadow = true));
  return body;
}

/** A head of spheres, in a head's frame, with the shapes that matter most: for rooms whose server has no avatars. */
export function plainHead(): Group {
  const skin = new MeshStandardMaterial({ color: 0xb98a6c, roughness: 0.7 });
  const root = new Group();
  const head = new Group();
  head.name = "Head";
  const skull = new SphereGeometry(0.105, 48, 36);
  skull.scale(0.86, 1.22, 1.02);
  skull.translate(0, -0.02, -0.075);
  head.add(new Mesh(skull, skin));
  for (const [name, x] of [
    ["Left", 1],
    ["Right", -1],
  ] as const) {
    const eye = new Group();
    eye.name = `${name}Eye`;
    eye.position.set(x * 0.033, 0, 0.005);
    eye.add(new Mesh(new SphereGeometry(0.0145, 24, 16), new MeshStandardMaterial({ color: 0xf4f2ee, roughness: 0.3 })));
    const iris = new Mesh(new SphereGeometry(0.0075, 16, 12), new MeshStandardMaterial({ color: 0x33251b, roughness: 0.3 }));
    iris.position.z = 0.0095;
    eye.add(iris);
    head.add(eye);
    const lid = new SphereGeometry(0.0158, 24, 8, 0, 2 * Math.PI, 0, Math.PI * 0.32);
    head.add(shaped(lid, skin, x * 0.033, 0, 0.005, { [`eyeBlink${name}`]: (px, py, pz) => [px, py - 0.012, pz + 0.009] }));
    const brow = new CapsuleGeometry(0.0035, 0.026, 4, 8).rotateZ(Math.PI / 2);
    const raised: Move = (px, py, pz) => [px, py + 0.012, pz];
    const lowered: Move = (px, py, pz) => [px, py - 0.008, pz];
    const dark = new MeshStandardMaterial({ color: 0x3a2a20 });
    head.add(
      shaped(brow, dark, x * 0.033, 0.027, 0.014, { browInnerUp: raised, [`browOuterUp${name}`]: raised, [`browDown${name}`]: lowered }),
    );
  }
  const nose = new Mesh(new SphereGeometry(0.014, 16, 12), skin);
  nose.scale.set(0.8, 1.4, 1);
  nose.position.set(0, -0.035, 0.03);
  const mouth = new SphereGeometry(0.022, 32, 16).scale(1, 0.16, 0.3);
  head.add(
    nose,
    shaped(mouth, new MeshStandardMaterial({ color: 0x5e2626, roughness: 0.6 }), 0, -0.072, 0.018, {
      jawOpen: (px, py, pz) => [px * 0.85, py < 0 ? py * 7 : py * 2, pz],
      mouthPucker: (px, py, pz) => [px * 0.5, py * 1.8, pz + 0.006],
      mouthFunnel: (px, py, pz) => [px * 0.6, py * 2.5, pz + 0.004],
      mouthSmileLeft: (px, py, pz) => (px > 0 ? [px * 1.25, py + 0.5 * px, pz] : [px, py, pz]),
      mouthSmileRight: (px, py, pz) => (px < 0 ? [px * 1.25, py - 0.5 * px, pz] : [px, py, pz]),
    }),
  );
  root.add(head);
  return root;
}

type Move = (x: number, y: number, z: number) => [number, number, number];

function shaped(geometry: SphereGeometry | CapsuleGeometry, material: MeshStandardMaterial, x: number, y: number, z: number, shapes: Record<string, Move>): Mesh {
  const places = geometry.getAttribute("position");
  geometry.morphAttributes.position = Object.entries(shapes).map(([name, move]) => {
    const moved: number[] = [];
    for (let i = 0; i < places.count; i++) moved.push(...move(places.getX(i), places.getY(i), places.getZ(i)));
    const shape = new Float32BufferAttribute(moved, 3);
    shape.name = name;
    return shape;
  });
  const mesh = new Mesh(geometry, material);
  mesh.position.set(x, y, z);
  return mesh;
}
