/** What is shown under loss, jitter and reordering lies close to what was sent, and goes to rest when nothing comes. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { REST, decode, encode, type Message } from "../line/protocol.js";
import { Playback, STALE_MS } from "../people/playback.js";

/** Numbers that look random and are the same every time (mulberry32). */
function numbers(seed: number): () => number {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let mixed = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Weights of somebody who talks: syllables at 4 Hz on the jaw, slower ones elsewhere. */
const jaw = (time: number): number => 0.3 + 0.25 * Math.sin((2 * Math.PI * 4 * time) / 1000);
const smile = (time: number): number => 0.5 + 0.5 * Math.sin((2 * Math.PI * 0.5 * time) / 1000);

function sent(time: number): Message {
  const weights = new Array<number>(52).fill(0);
  weights[17] = jaw(time);
  weights[23] = smile(time);
  return { ...REST, time_ms: Math.round(time) % 2 ** 32, weights, heading: 3.1 + time / 5000, floor_m: [time / 1000, 0] };
}

interface Network {
  loss: number;
  jitter: number;
  origin?: number;
}

/** Mean and greatest error of shown weights against those of the moment shown, over 20 s. */
function play({ loss, jitter, origin = 0 }: Network): { mean: number; most: number; delay: number; moved: boolean } {
  const random = numbers(7);
  const playback = new Playback();
  const arriving: { at: number; message: Message }[] = [];
  for (let time = 0; time < 20_000; time += 1000 / 30) {
    // over TCP what is lost comes late, over others not at all; both are tolerated
    const message = decode(encode({ ...sent(time), time_ms: (Math.round(time) + origin) % 2 ** 32 }));
    if (random() >= loss) arriving.push({ at: time + 30 + jitter * random(), message });
  }
  arriving.sort((a, b) => a.at - b.at);
  const errors: number[] = [];
  let [next, last, moved] = [0, -Infinity, true];
  for (let now = 0; now < 20_000; now += 1000 / 60) {
    while (next < arriving.length && arriving[next]!.at <= now) playback.push(arriving[next]!.message, arriving[next++]!.at);
    const shown = playback.at(now);
    if (!shown || now < 2000) continue;
    // which moment is shown is read from the place, which moves by a metre a second
    const moment = shown.floor_m[0]! * 1000;
    moved &&= moment >= last - 1e-6;
    last = moment;
    errors.push((Math.abs(shown.weights[17]! - jaw(moment)) + Math.abs(shown.weights[23]! - smile(moment))) / 2);
  }
  const mean = errors.reduce((sum, error) => sum + error, 0) / errors.length;
  return { mean, most: Math.max(...errors), delay: playback.delayMs, moved };
}

test("on a good line, what is shown is what was sent", () => {
  const { mean, delay } = play({ loss: 0, jitter: 2 });
  assert.ok(mean < 0.01, `mean error ${mean}`);
  assert.ok(delay < 60, `delay ${delay}`);
});

test("at 5 % loss and 80 ms jitter the mean error is at most .02", () => {
  const { mean, delay } = play({ loss: 0.05, jitter: 80 });
  console.log(`mean error ${mean.toFixed(4)}, delay ${delay.toFixed(0)} ms`);
  assert.ok(mean <= 0.02, `mean error ${mean}`);
  assert.ok(delay > 60 && delay < 200, `delay ${delay}`);
});

test("the sender's clock may wrap", () => {
  const { mean } = play({ loss: 0.05, jitter: 80, origin: 2 ** 32 - 10_000 });
  assert.ok(mean <= 0.02, `mean error ${mean}`);
});

test("nobody is shown going backwards by more than the delay's growth", () => {
  assert.ok(play({ loss: 0, jitter: 0 }).moved);
});

test("the delay grows with jitter and shrinks again", () => {
  const playback = new Playback();
  for (let step = 0; step < 300; step++) playback.push(sent(step * 33), step * 33 + (step === 50 ? 250 : 20));
  const grown = playback.delayMs;
  assert.ok(grown > 200, `${grown}`);
  for (let now = 10_000; now < 30_000; now += 16) playback.at(now);
  assert.ok(playback.delayMs < 80, `${playback.delayMs}`);
});

test("when nothing comes any more, the face goes to rest where it stands", () => {
  const playback = new Playback();
  for (let step = 0; step < 30; step++) playback.push({ ...sent(step * 33), flags: 1, animation: 3 }, step * 33);
  const before = playback.at(1000)!;
  assert.ok(before.weights[17]! > 0 && before.flags === 1);
  const after = playback.at(1000 + STALE_MS + 1000)!;
  assert.ok(after.weights[17]! < 0.02 && after.flags === 0 && after.animation === 0);
  assert.ok(Math.abs(after.floor_m[0]! - before.floor_m[0]!) < 0.05);
});

test("a page that nobody sees speaks once a second, and a raised hand stays up", () => {
  const playback = new Playback();
  for (let step = 0; step < 10; step++) playback.push({ ...sent(step * 1050), flags: 1, animation: 5 }, step * 1050);
  for (let step = 10; step < 20; step++) {
    playback.push({ ...sent(step * 1050), flags: 1, animation: 5 }, step * 1050);
    for (let now = step * 1050; now < (step + 1) * 1050; now += 16) assert.equal(playback.at(now)!.animation, 5);
  }
});

for (const ahead of [4_000_000, 3000, -3000]) {
  test(`another clock takes over, ${ahead} ms ahead`, () => {
    const playback = new Playback();
    for (let step = 0; step < 30; step++) playback.push(sent(10_000 + step * 33), step * 33);
    for (let step = 0; step < 30; step++) {
      playback.push({ ...sent(11_000 + ahead + step * 33), floor_m: [99, step] }, 1000 + step * 33);
    }
    const shown = playback.at(2000)!;
    assert.equal(shown.floor_m[0], 99);
    assert.ok(shown.floor_m[1]! > 25);
  });
}

test("after a standstill of two seconds the newest is shown", () => {
  const playback = new Playback();
  for (let step = 0; step < 120; step++) {
    const time = step * 33;
    playback.push(sent(time), time > 1000 && time < 3000 ? 3000 + step / 1000 : time + 20);
  }
  assert.ok(playback.at(120 * 33 + 20)!.floor_m[0]! > 3.6);
});
