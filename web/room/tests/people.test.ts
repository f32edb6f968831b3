/** Whoever leaves takes along what the graphics card held for them, and whoever stays keeps what they wear. */

import { strict as assert } from "node:assert";
import { mock, test } from "node:test";
import { Bone, Mesh, Scene, Skeleton, SkinnedMesh, Sprite, type BufferGeometry, type Material } from "three";

import { Avatar } from "../../avatar/avatar.js";
import { Figure } from "../figure/figure.js";
import type { Person } from "../line/texts.js";
import { PLAIN, Wardrobe, type Dressed } from "../people/avatars.js";
import type { Brought } from "../people/brought.js";
import { People } from "../people/people.js";

const ADA = { number: 7, name: "Ada", avatar: PLAIN, own: "", id: "0".repeat(16), present: true } as unknown as Person;

/** Let time pass, and what waited for it go on. */
async function passed(ms: number): Promise<void> {
  if (ms) mock.timers.tick(ms);
  for (let turn = 0; turn < 20; turn++) await Promise.resolve();
}

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

/** Who wears what nobody has to fetch. */
function crowd(fetched: () => Promise<Dressed | undefined> = async () => undefined): People {
  const brought = { wears: () => undefined, fetch: fetched } as unknown as Brought;
  return new People({ scene: new Scene(), hide: () => undefined }, brought);
}

test("whoever is still there behind a break of the line keeps their figure", () => {
  const people = crowd();
  const [ben, eve] = [{ ...ADA, number: 8, id: "b" }, { ...ADA, number: 9, id: "e" }];
  people.welcome([ADA, ben, eve], 8);
  const figures = [7, 8, 9].map((number) => people.known.get(number)!.figure);
  people.welcome([ADA, ben, { ...eve, id: "f" }], 8);
  const after = [7, 8, 9].map((number) => people.known.get(number)!.figure);
  assert.deepEqual(after.map((figure, index) => figure === figures[index]), [true, true, false]);
  people.welcome([ADA, { ...ben, own: "0a" }], 8);
  assert.deepEqual([...people.known.keys()], [7, 8]);
});

test("an avatar of the room that did not come is asked for again, until its person wears another", async () => {
  mock.timers.enable({ apis: ["setTimeout"] });
  const asked: string[] = [];
  const another = Wardrobe.prototype.another;
  Wardrobe.prototype.another = async (name) => {
    asked.push(name);
    return asked.length < 3 ? undefined : { avatar: new Avatar(name, new Mesh()), height: 1.7 };
  };
  try {
    const people = crowd();
    people.meet({ ...ADA, avatar: "nora" });
    for (let second = 0; second < 60; second++) await passed(1000);
    assert.deepEqual(asked, ["nora", "nora", "nora"]);
    assert.equal(people.known.get(ADA.number)!.figure!.avatar.name, "nora");
    asked.length = 0;
    people.meet({ ...ADA, avatar: "omar" });
    await passed(0);
    people.meet(ADA);
    for (let second = 0; second < 60; second++) await passed(1000);
    assert.deepEqual(asked, ["omar"]);
  } finally {
    Wardrobe.prototype.another = another;
    mock.timers.reset();
  }
});

test("what somebody brought may be there before the room's, and stays on", async () => {
  const another = Wardrobe.prototype.another;
  let come: (dressed: Dressed) => void = () => undefined;
  Wardrobe.prototype.another = () => new Promise((resolve) => (come = resolve));
  try {
    const people = crowd(async () => ({ avatar: new Avatar("brought", new Mesh()), height: 1.7 }));
    people.meet({ ...ADA, avatar: "nora", own: "0a" });
    const worn = (): string => people.known.get(ADA.number)!.figure!.avatar.name;
    await passed(0);
    assert.equal(worn(), "brought");
    come({ avatar: new Avatar("nora", new Mesh()), height: 1.7 });
    await passed(0);
    assert.equal(worn(), "brought");
  } finally {
    Wardrobe.prototype.another = another;
  }
});

test("of an avatar that cannot be drawn the room's stands in, of that one the plain head, and of that one nothing", async () => {
  const another = Wardrobe.prototype.another;
  Wardrobe.prototype.another = async (name) => ({ avatar: new Avatar(name, new Mesh()), height: 1.7 });
  try {
    let fetched = 0;
    const people = crowd(async () => (fetched++, { avatar: new Avatar("brought", new Mesh()), height: 1.7 }));
    const ada = { ...ADA, avatar: "nora", own: "0a" };
    people.meet(ada);
    const known = people.known.get(ADA.number)!;
    for (const wears of ["brought", "nora", PLAIN, PLAIN]) {
      await passed(0);
      assert.equal(known.figure!.avatar.name, wears);
      people.welcome([ada], 1); // brings nothing back that was refused
      people.refuse(known);
    }
    assert.equal(fetched, 1);
    people.meet({ ...ada, own: "0b" });
    await passed(0);
    assert.equal(known.figure!.avatar.name, "brought");
  } finally {
    Wardrobe.prototype.another = another;
  }
});

test("who brings what no figure can be made of keeps what they wore", async () => {
  mock.method(console, "warn", () => undefined);
  const brought = new Avatar("brought", new Mesh());
  Object.defineProperty(brought, "headJoint_m", { get: () => assert.fail("broken") });
  const people = crowd(async () => ({ avatar: brought, height: 1.7 }));
  people.meet({ ...ADA, own: "0a" });
  await passed(0);
  assert.equal(people.known.get(ADA.number)!.figure!.avatar.name, PLAIN);
});
