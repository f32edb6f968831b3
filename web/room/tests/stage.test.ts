/** An avatar that breaks each picture off is taken off, and nobody's is where one picture broke off by itself. */

import assert from "node:assert/strict";
import { mock, test } from "node:test";

import { Stage } from "../stage.js";

mock.method(console, "warn", () => undefined);

/** Three people, and a picture that may break off; whom a picture refuses, and who is seen after it. */
function paint(breaks: (seen: string[], picture: number) => boolean): { refused: string[]; seen: string[] } {
  const known = ["Ada", "Ben", "Cy"].map((name) => ({ name, figure: { root: { visible: true } } }));
  const seen = (): string[] => known.filter(({ figure }) => figure.root.visible).map(({ name }) => name);
  const refused: string[] = [];
  let picture = 0;
  const stage = Object.assign(Object.create(Stage.prototype) as object, {
    view: {
      draw: () => {
        if (breaks(seen(), picture++)) throw new Error("no picture");
      },
    },
  }) as unknown as { paint(people: object): void };
  stage.paint({ known: new Map(known.entries()), refuse: ({ name }: { name: string }) => refused.push(name) });
  return { refused, seen: seen() };
}

const ALL = ["Ada", "Ben", "Cy"];

for (const culprit of ALL) {
  test(`of three ${culprit} alone is taken off, and all are seen again`, () => {
    assert.deepEqual(paint((seen) => seen.includes(culprit)), { refused: [culprit], seen: ALL });
  });
}

test("a picture that breaks off by itself undresses nobody", () => {
  for (const times of [0, 1, 2, 3]) assert.deepEqual(paint((_, picture) => picture < times), { refused: [], seen: ALL });
});

test("where no picture comes whoever is left out, nobody is undressed", () => {
  assert.deepEqual(paint(() => true), { refused: [], seen: ALL });
});
