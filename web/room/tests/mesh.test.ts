/** A connection that never comes about is tried again by one of the two; one that came about is let alone. */

import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import type { Person } from "../line/texts.js";
import { Mesh } from "../voice/mesh.js";

class Connection extends EventTarget {
  static made: Connection[] = [];
  connectionState = "new";
  signalingState = "stable";
  remoteDescription = null;
  calls = 0;

  constructor() {
    super();
    Connection.made.push(this);
  }

  addTransceiver(): void {
    this.calls++;
  }

  getTransceivers(): [] {
    return [];
  }

  close(): void {
    this.connectionState = "closed";
  }
}

Object.assign(globalThis, { RTCPeerConnection: Connection });
mock.timers.enable({ apis: ["setTimeout"] });
beforeEach(() => void (Connection.made = []));

function meet(own: string): Mesh {
  const mesh = new Mesh(() => undefined, { play: () => undefined, stop: () => undefined });
  mesh.meet(new Map([["m", { id: "m", number: 1, visit: "v", present: true } as Person]]), own);
  return mesh;
}

test("the impolite one calls again where nothing came of a call", () => {
  meet("z");
  mock.timers.tick(29_000);
  assert.equal(Connection.made.length, 1);
  mock.timers.tick(2_000);
  assert.deepEqual(
    Connection.made.map(({ connectionState, calls }) => [connectionState, calls]),
    [["closed", 1], ["new", 1]],
  );
  Connection.made[1]!.connectionState = "connected";
  mock.timers.tick(100_000);
  assert.equal(Connection.made.length, 2);
});

test("the polite one waits, and who left is not called", () => {
  meet("a");
  mock.timers.tick(100_000);
  assert.equal(Connection.made.length, 1);
  const mesh = meet("z");
  mesh.part("m");
  mock.timers.tick(100_000);
  assert.equal(Connection.made.length, 2);
});
