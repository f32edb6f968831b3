/** People in one avatar are told apart, the same way on every page; what they share stays as it is. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { BoxGeometry, Group, Mesh, MeshStandardMaterial } from "three";

import { CLOTHES, coloursOf, dye, written } from "../figure/colours.js";

const ADA = { number: 3, id: "0123456789abcdef" };
const BEN = { number: 4, id: "fedcba9876543210" };

function avatar(hair: number): { root: Group; of(name: string): MeshStandardMaterial; all: MeshStandardMaterial[] } {
  const root = new Group();
  const all = ["skin", "top", "trousers", "hair"].map((name) => new MeshStandardMaterial({ name, color: name === "hair" ? hair : 0xffffff }));
  for (const material of [...all, all[1]!]) root.add(new Mesh(new BoxGeometry(), material));
  const of = (name: string): MeshStandardMaterial =>
    root.children.map((node) => (node as Mesh).material as MeshStandardMaterial).find((each) => each.name === name)!;
  return { root, of, all };
}

test("two in one avatar wear other clothes, and no skin is coloured", () => {
  const [one, two] = [avatar(0xff8800), avatar(0xff8800)];
  const shared = one.all.map((each) => each.color.getHex());
  dye(one.root, coloursOf(ADA));
  dye(two.root, coloursOf(BEN));
  assert.equal(one.of("top").color.getHex(), CLOTHES[3]);
  assert.equal(one.of("trousers").color.getHex(), CLOTHES[3]);
  assert.notEqual(one.of("top").color.getHex(), two.of("top").color.getHex());
  assert.equal(one.of("skin"), one.all[0]);
  assert.deepEqual(one.all.map((each) => each.color.getHex()), shared, "the avatar that all share");
});

test("a person looks alike on every page, and in the replay of a meeting", () => {
  const hairs = [ADA, { ...ADA }, { number: 3, id: `replay-${ADA.id}-3` }].map((who) => {
    const { root, of } = avatar(0xff8800);
    dye(root, coloursOf(who));
    return of("hair").color.getHex();
  });
  assert.equal(new Set(hairs).size, 1);
});

test("dark hair stays dark, and hair differs between people", () => {
  const seen = { dark: new Set<number>(), fair: new Set<number>() };
  for (let person = 0; person < 64; person++) {
    const id = (person * 0x9e3779b1).toString(16).padStart(16, "0").slice(-16);
    for (const [kind, own] of [["dark", 0x100b0a], ["fair", 0xc08040]] as const) {
      const { root, of } = avatar(own);
      dye(root, coloursOf({ number: 0, id }));
      seen[kind].add(of("hair").color.getHex());
    }
  }
  assert.equal(seen.fair.size, 6);
  assert.equal(seen.dark.size, 4);
});

test("a colour is written as pages read it", () => {
  assert.equal(written(0x00ff08), "#00ff08");
});

test("what is dyed is freed, and nothing else", () => {
  const { root, all } = avatar(0xff8800);
  const freed: string[] = [];
  for (const each of all) each.addEventListener("dispose", () => freed.push(`shared ${each.name}`));
  const free = dye(root, coloursOf(ADA));
  for (const node of root.children) {
    const own = (node as Mesh).material as MeshStandardMaterial;
    if (!all.includes(own)) own.addEventListener("dispose", () => freed.push(own.name));
  }
  free();
  assert.deepEqual([...new Set(freed)].sort(), ["hair", "top", "trousers"]);
});
