/** Who speaks has the sign within three frames of 20 ms; clicks never have it, and breaths between words do not end it. */

import assert from "node:assert/strict";
import { test } from "node:test";

Object.assign(globalThis, { self: globalThis });
const { HANG_MS, SpeakingSign } = await import("../voice/microphone.js");

const FRAME_MS = 20;

/** The sign at each frame, of which some are voiced. */
function signs(voiced: (frame: number) => boolean, frames: number): boolean[] {
  const sign = new SpeakingSign();
  return Array.from({ length: frames }, (_, frame) => sign.hear(voiced(frame), frame * FRAME_MS));
}

test("the third voiced frame turns it on, and it stays for 0.4 s behind the last", () => {
  const shown = signs((frame) => frame >= 10 && frame < 50, 100);
  assert.equal(shown.indexOf(true), 12);
  // frames 50 and 51 still have three voiced ones among the last five
  assert.equal(shown.lastIndexOf(true), 51 + HANG_MS / FRAME_MS - 1);
});

test("two voiced frames of five are a click", () => {
  assert.ok(!signs((frame) => frame % 5 < 2, 200).includes(true));
});

test("a breath of a third of a second is no end", () => {
  const shown = signs((frame) => frame < 20 || frame >= 36, 60);
  assert.ok(!shown.slice(2).includes(false));
});
