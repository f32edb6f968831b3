/** How loud somebody is, whatever the slider beside the name says of whom a moderator has muted; and where the ears are. */

import assert from "node:assert/strict";
import { test } from "node:test";

import type { Person } from "../line/texts.js";

/** Takes every call and every property of what a browser has and Node has not. */
class Anything {
  readonly gain: { value: number };
  readonly listener: Record<string, unknown> = {};
  connectionState = "connected";
  state = "running";
  constructor(_context?: unknown, options?: { gain?: number }) {
    this.gain = { value: options?.gain ?? 1 };
  }
  connect(next: unknown): unknown {
    return next;
  }
  disconnect(): void {}
  close(): void {}
  addEventListener(): void {}
  addTransceiver(): void {}
  createMediaStreamSource(): Anything {
    return new Anything();
  }
  play(): Promise<void> {
    return Promise.resolve();
  }
}
for (const name of ["AudioContext", "RTCPeerConnection", "PannerNode", "AnalyserNode", "Audio", "MediaStream"]) {
  Object.assign(globalThis, { [name]: class extends Anything {} });
}
let loudness = { value: NaN };
class Gain extends Anything {
  constructor(context: unknown, options: { gain?: number }) {
    super(context, options);
    loudness = this.gain;
  }
}
Object.assign(globalThis, { GainNode: Gain });

Object.assign(globalThis, { addEventListener: () => undefined });
const { Voice } = await import("../voice/voice.js");

const person = (muted: boolean): Person => ({
  number: 1,
  id: "b",
  name: "Ben",
  avatar: "plain",
  visit: "",
  moderator: false,
  present: true,
  voice: true,
  muted,
  face: "page",
});

test("a slider makes nobody heard whom a moderator has muted", () => {
  const voice = new Voice(() => undefined);
  voice.configure([], false);
  voice.meet([person(false)], "a");
  voice.play("b", {} as MediaStreamTrack);
  voice.setVolume("b", 0.5);
  assert.equal(loudness.value, 0.5);
  voice.meet([person(true)], "a");
  assert.equal(loudness.value, 0);
  voice.setVolume("b", 1.5);
  assert.equal(loudness.value, 0);
  voice.meet([person(false)], "a");
  assert.equal(loudness.value, 1.5);
});

test("ears are where the head is, also in a browser that has the old calls alone", () => {
  const voice = new Voice(() => undefined);
  const said: number[][] = [];
  const say = (...numbers: number[]): void => void said.push(numbers);
  Object.assign(voice.context.listener, { setPosition: say, setOrientation: say });
  voice.listen({ x: 1, y: 1.6, z: -2 }, Math.PI / 2);
  assert.deepEqual(said[0], [1, 1.6, -2]);
  assert.deepEqual(said[1]!.map(Math.round), [1, 0, 0, 0, 1, 0]);
});

test("of whom one cannot hear for ten seconds it is told, and why", () => {
  const voice = new Voice(() => undefined);
  let state = "connecting";
  voice.state = () => state as RTCPeerConnectionState;
  const told = (now: number): [boolean, boolean, string] => [voice.watch(now), voice.lacks("b"), voice.word];
  voice.configure([], false);
  voice.meet([{ ...person(false), id: "a" }, person(false)], "a");
  assert.deepEqual(told(0), [false, false, ""]);
  assert.deepEqual(told(9900), [false, false, ""]);
  const [anew, lacks, word] = told(10_100);
  assert.deepEqual([anew, lacks], [true, true]);
  assert.match(word, /from Ben: .*no relay/);
  assert.equal(told(10_200)[0], false);
  voice.configure([{ urls: ["stun:s", "turn:t"] }], false);
  assert.match(voice.word, /not even by the room's relay/);
  state = "connected";
  assert.deepEqual(told(11_000), [true, false, ""]);
  state = "disconnected"; // finds its way again in less
  told(12_000);
  state = "connected";
  told(20_000);
  state = "failed";
  assert.deepEqual(told(23_000), [false, false, ""]);
});

test("nobody waits for a voice that is not there", () => {
  const voice = new Voice(() => undefined);
  voice.state = () => "new";
  for (const less of [{ voice: false }, { muted: true }, { present: false }, { replayed: true }]) {
    voice.meet([{ ...person(false), ...less }], "a");
    voice.watch(0);
    assert.deepEqual([voice.watch(60_000), voice.lacks("b")], [false, false]);
  }
});
