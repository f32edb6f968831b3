/** One's own body by keys, by mouse and by two fingers at once. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { Layout } from "../scene/layout.js";

let page: EventTarget;
Object.assign(globalThis, {
  HTMLElement: class {},
  addEventListener: (name: string, act: (event: Event) => void) => page.addEventListener(name, act),
  document: { querySelector: () => null },
});
const { Walk } = await import("../scene/walk.js");

class Canvas extends EventTarget {
  readonly clientWidth = 900;
  readonly clientHeight = 900;
  setPointerCapture(): void {}
}

let canvas: Canvas;
let walk: InstanceType<typeof Walk>;
beforeEach(() => {
  page = new EventTarget();
  canvas = new Canvas();
  walk = new Walk(canvas as unknown as HTMLElement, new Layout([]));
});

function say(to: EventTarget, kind: string, told: object): void {
  to.dispatchEvent(Object.assign(new Event(kind), told));
}

const key = (kind: string, code: string): void => say(page, kind, { code });

function point(kind: string, pointerId: number, clientX: number, clientY: number, more: object = {}): void {
  say(canvas, kind, { pointerId, clientX, clientY, pointerType: "mouse", button: 0, buttons: 1, ...more });
}

const TOUCH = { pointerType: "touch" };

test("who is seated turns and looks up by keys, and stays on the seat", () => {
  for (const code of ["KeyW", "KeyQ", "KeyR"]) key("keydown", code);
  walk.update(0.5, true);
  assert.deepEqual([walk.x, walk.z, walk.heading, walk.pitch], [0, 0, 0.9, 0.45]);
  key("keyup", "KeyQ");
  walk.update(0.5);
  assert.ok(Math.hypot(walk.x, walk.z) > 0.6);
  walk.update(10, true);
  assert.equal(walk.pitch, 0.9, "nobody looks further than a neck lets them");
});

test("a drag looks around until the button is up, wherever that was", () => {
  point("pointerdown", 1, 100, 100);
  point("pointermove", 1, 50, 100);
  assert.equal(walk.heading, 0.2);
  point("pointermove", 1, 0, 100, { buttons: 0 });
  point("pointermove", 1, 500, 100);
  assert.equal(walk.heading, 0.2);
});

test("another button drags nothing", () => {
  point("pointerdown", 1, 100, 100, { button: 2, buttons: 2 });
  point("pointermove", 1, 50, 100, { button: -1, buttons: 0 });
  point("pointermove", 1, 0, 0);
  assert.deepEqual([walk.heading, walk.pitch], [0, 0]);
});

test("a thumb walks while a finger looks around, and each ends by itself", () => {
  point("pointerdown", 1, 200, 800, TOUCH);
  point("pointerdown", 2, 600, 200, TOUCH);
  point("pointermove", 1, 200, 740, TOUCH);
  point("pointermove", 2, 550, 200, TOUCH);
  assert.equal(walk.heading, 0.2);
  point("pointerup", 2, 550, 200, TOUCH);
  walk.update(0.5);
  const walked = Math.hypot(walk.x, walk.z);
  assert.ok(Math.abs(walked - 0.7) < 1e-9);
  point("pointerup", 1, 200, 740, TOUCH);
  walk.update(0.5);
  assert.equal(Math.hypot(walk.x, walk.z), walked);
});
