/** Files of avatars are asked for until they come, and kept while the meeting lasts; one's own is brought until it is taken. */

import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { Files, MOST_AT_ONCE, MOST_KEPT_BYTES } from "../people/files.js";

class Part {
  textContent = "";
  addEventListener(): void {}
}
Object.assign(globalThis, {
  document: { getElementById: () => new Part() },
  window: globalThis,
  addEventListener: () => undefined,
});
const { Brought } = await import("../people/brought.js");

let asked: string[] = [];
let answers: (() => Response)[] = [];
globalThis.fetch = async (address) => {
  asked.push(String(address));
  return (answers.length > 1 ? answers.shift()! : answers[0]!)();
};

async function passed(ms: number): Promise<void> {
  for (let second = 0; second <= ms; second += 1000) {
    mock.timers.tick(1000);
    for (let turn = 0; turn < 20; turn++) await Promise.resolve();
  }
}

const failing = (status: number) => () => new Response("no", { status });
const giving = (bytes: number) => (): Response => new Response(new Uint8Array(bytes));

beforeEach(() => {
  asked = [];
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
});

test("a file that fails is asked for again with growing waits, and comes", async () => {
  const broken = (): never => {
    throw new TypeError("Failed to fetch");
  };
  answers = [failing(503), broken, failing(404), giving(5)];
  mock.method(console, "warn", () => undefined);
  const found = new Files("/avatar", "key").fetch("d1", () => true);
  await passed(1000);
  assert.equal(asked.length, 1);
  await passed(60_000);
  assert.equal(asked.length, 4);
  assert.equal((await found)!.byteLength, 5);
});

test("a file that nobody wears any more is not asked for again", async () => {
  answers = [failing(503)];
  let wanted = true;
  const found = new Files("/avatar", "key").fetch("d1", () => wanted);
  await passed(1000);
  wanted = false;
  await passed(600_000);
  assert.deepEqual([asked, await found], [["/avatar/d1"], undefined]);
});

test("files are kept by their digest, the newest within a bound", async () => {
  const files = new Files("/avatar", "key");
  answers = [giving(MOST_KEPT_BYTES / 4)];
  for (const digest of ["d1", "d2", "d3", "d4", "d1", "d5"]) await files.fetch(digest, () => true);
  assert.equal(asked.length, 5);
  await files.fetch("d1", () => true); // was worn again before d5 came
  assert.equal(asked.length, 5);
  await files.fetch("d2", () => true);
  assert.deepEqual(asked.slice(5), ["/avatar/d2"]);
});

test("few files are on their way at one time, and all come, each once", async () => {
  const files = new Files("/avatar", "key");
  const given: (() => void)[] = [];
  const real = globalThis.fetch;
  globalThis.fetch = async (address) => {
    asked.push(String(address));
    await new Promise<void>((resolve) => given.push(resolve));
    return new Response(new Uint8Array(5));
  };
  const unwanted = "d4";
  const digests = ["d1", "d2", "d3", "d4", "d5", "d1"];
  const found = digests.map((digest) => files.fetch(digest, () => digest !== unwanted || asked.length === 0));
  for (let left = 10; left; left--) {
    await passed(0);
    assert.ok(given.length <= MOST_AT_ONCE);
    given.shift()?.();
  }
  const sizes = (await Promise.all(found)).map((content) => content?.byteLength);
  globalThis.fetch = real;
  assert.deepEqual(sizes, [5, 5, 5, undefined, 5, 5]);
  assert.deepEqual(asked, ["/avatar/d1", "/avatar/d2", "/avatar/d3", "/avatar/d5"]);
});

for (const [status, tries] of [[403, 2], [422, 1], [507, 1]] as const) {
  test(`an own avatar that was answered by ${status} is brought ${tries} times in four welcomes`, async () => {
    const brought = new Brought("/avatar", "key", "secret", () => undefined);
    Object.assign(brought, { file: { name: "me.glb", content: new ArrayBuffer(8) } });
    answers = [failing(status)];
    for (let welcome = 0; welcome < 4; welcome++) {
      brought.again();
      await passed(60_000);
    }
    assert.equal(asked.length, tries);
    assert.equal(brought.wanted, false);
  });
}

test("an own avatar that came while its person was away is brought when they are back", async () => {
  const brought = new Brought("/avatar", "key", "secret", () => undefined);
  Object.assign(brought, { file: { name: "me.glb", content: new ArrayBuffer(8) } });
  answers = [failing(403), () => Response.json({ own: "d1" })];
  brought.again();
  await passed(1000);
  brought.again();
  await passed(1000);
  brought.wears("d1");
  brought.again();
  await passed(1000);
  assert.deepEqual([asked.length, brought.wanted], [2, true]);
});
