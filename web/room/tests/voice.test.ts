/** How loud somebody is: what a moderator has muted stays so, whatever the slider beside the name says. */

import assert from "node:assert/strict";
import { test } from "node:test";

import type { Person } from "../texts.js";

/** Takes every call and every property of what a browser has and Node has not. */
class Anything {
  readonly gain: { value: number };
  connectionState = "connected";
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

const { Voice } = await import("../voice.js");

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
