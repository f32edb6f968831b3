/** A face without a camera blinks so that others see it, however seldom states are sent and pictures drawn. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { SHAPE_INDEX } from "../../avatar/index.js";
import { Idle } from "../face/own.js";
import { decode, encode, REST } from "../line/protocol.js";
import { Playback } from "../people/playback.js";

const LID = SHAPE_INDEX.get("eyeBlinkLeft")!;

/** The highest lid of each blink that is shown in ten minutes, so many pictures a second. */
function blinks(pictures: number): number[] {
  const [idle, playback] = [new Idle(), new Playback()];
  const highest: number[] = [];
  let [sent, open] = [0, true];
  for (let now = 0; now < 600_000; now += 1000 / pictures) {
    for (; sent <= now; sent += 1000 / 30) {
      const { weights } = idle.update(1 / 30, 0);
      playback.push(decode(encode({ ...REST, time_ms: Math.round(sent), weights })), sent);
    }
    const lid = playback.at(now)!.weights[LID]!;
    if (lid > 0 && open) highest.push(0);
    open = lid === 0;
    if (!open) highest.push(Math.max(highest.pop()!, lid));
  }
  return highest;
}

for (const [pictures, least, mean] of [[60, 0.9, 0.97], [30, 0.85, 0.95], [15, 0.65, 0.8]] as const) {
  test(`lids close in what is shown, at ${pictures} pictures a second`, () => {
    const shown = blinks(pictures);
    const found = shown.reduce((sum, lid) => sum + lid, 0) / shown.length;
    assert.ok(shown.length > 100 && shown.length < 200, `${shown.length} blinks`);
    assert.ok(Math.min(...shown) >= least, `${Math.min(...shown)}`);
    assert.ok(found >= mean, `${found}`);
  });
}
