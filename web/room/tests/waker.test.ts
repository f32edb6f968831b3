/** Sound that a browser has halted is asked for again whenever there is hope, and a sentence says what is left to do. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

let page: EventTarget;
let now = 0;
performance.now = () => now;
Object.assign(globalThis, {
  addEventListener: (name: string, act: () => void) => page.addEventListener(name, act),
  removeEventListener: (name: string, act: () => void) => page.removeEventListener(name, act),
});
const { Waker } = await import("../voice/waker.js");

class Context extends EventTarget {
  state = "suspended";
  asked = 0;
  resume = async (): Promise<void> => {
    this.asked++;
    throw new Error("not allowed yet");
  };
  close = async (): Promise<void> => this.become("closed");
  become(state: string): void {
    this.state = state;
    this.dispatchEvent(new Event("statechange"));
  }
}

function wake(): { context: Context; waker: InstanceType<typeof Waker> } {
  const context = new Context();
  return { context, waker: new Waker(context as unknown as AudioContext) };
}

beforeEach(() => {
  page = new EventTarget();
  now = 0;
});

test("sound that begins by itself is no matter to speak of", () => {
  const { context, waker } = wake();
  assert.equal(context.asked, 1);
  now = 500;
  assert.equal(waker.word, "");
  context.become("running");
  now = 60_000;
  assert.equal(waker.word, "");
});

test("before a page is touched it is silent, and says so; a touch wakes it", () => {
  const { context, waker } = wake();
  now = 2500;
  assert.match(waker.word, /click/);
  page.dispatchEvent(new Event("pointerup"));
  assert.equal(context.asked, 2);
  context.become("running");
  assert.equal(waker.word, "");
  page.dispatchEvent(new Event("keydown"));
  assert.equal(context.asked, 2);
});

test("behind a call sound comes back with the page, and a meeting that is over asks for none", () => {
  const { context, waker } = wake();
  context.become("running");
  now = 60_000;
  context.become("interrupted");
  assert.deepEqual([context.asked, waker.word], [2, ""]);
  now = 63_000;
  assert.match(waker.word, /click/);
  page.dispatchEvent(new Event("visibilitychange"));
  assert.equal(context.asked, 3);
  waker.close();
  page.dispatchEvent(new Event("pointerdown"));
  assert.deepEqual([context.asked, waker.word], [3, ""]);
});
