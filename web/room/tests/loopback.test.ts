/** Which way the room's sound goes: by the loopback while that stands, and straight before, while it is cut, and with headphones. */

import assert from "node:assert/strict";
import { mock, test } from "node:test";

const ways: string[] = [];

class Node {
  readonly stream = { getAudioTracks: () => [{}] };
  constructor(readonly name = "other") {}
  connect(next: Node): Node {
    if (this.name === "mix") ways.push(next.name);
    return next;
  }
  disconnect(): void {
    if (this.name === "mix") ways.length = 0;
  }
}
class Context {
  readonly destination = new Node("straight");
  readonly state: string = "running";
  addEventListener(): void {}
}
const connections: Connection[] = [];
class Connection {
  connectionState = "new";
  localDescription = { type: "offer", sdp: "a=rtpmap:111 opus/48000/2\r\na=fmtp:111 minptime=10\r\n" };
  onconnectionstatechange: () => void = () => undefined;
  remote: string[] = [];
  constructor() {
    connections.push(this);
  }
  addTrack(): void {}
  close(): void {}
  createAnswer = async (): Promise<unknown> => this.localDescription;
  setLocalDescription = async (): Promise<void> => undefined;
  setRemoteDescription = async ({ sdp }: { sdp: string }): Promise<void> => void this.remote.push(sdp);
  become(state: string): void {
    this.connectionState = state;
    this.onconnectionstatechange();
  }
}
Object.assign(globalThis, {
  AudioContext: Context,
  GainNode: class extends Node {
    constructor() {
      super("mix");
    }
  },
  MediaStreamAudioDestinationNode: class extends Node {
    constructor() {
      super("loopback");
    }
  },
  RTCPeerConnection: Connection,
  Audio: class {
    play = async (): Promise<void> => undefined;
  },
});

Object.assign(globalThis, { addEventListener: () => undefined });
const { Voice } = await import("../voice/voice.js");
const settled = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));
mock.timers.enable({ apis: ["setTimeout"] });

test("with headphones sound goes straight, and no connection is made", () => {
  ways.length = 0;
  assert.equal(new Voice(() => undefined).loopback, undefined);
  assert.deepEqual(ways, ["straight"]);
  assert.equal(connections.length, 0);
});

test("without, it goes by the loopback as soon and as long as that stands, in stereo", async () => {
  ways.length = 0;
  new Voice(() => undefined, { echoes: true });
  assert.deepEqual(ways, ["straight"]);
  await settled();
  const [near, far] = connections as [Connection, Connection];
  for (const { remote } of [near, far]) assert.match(remote[0]!, /a=fmtp:111 minptime=10;stereo=1;sprop-stereo=1/);
  far.become("connected");
  await settled();
  assert.deepEqual(ways, ["loopback"]);
  far.become("disconnected");
  await settled();
  assert.deepEqual(ways, ["straight"]);
  far.become("connected");
  await settled();
  assert.deepEqual(ways, ["loopback"]);
  far.become("failed");
  await settled();
  assert.deepEqual(ways, ["straight"]);
  mock.timers.tick(2000);
  assert.equal(connections.length, 4, "another pair takes its place");
  far.become("connected"); // late, and of no matter
  await settled();
  assert.deepEqual(ways, ["straight"]);
  connections[3]!.become("connected");
  await settled();
  assert.deepEqual(ways, ["loopback"]);
});

test("what the browser does not play goes straight", async () => {
  ways.length = 0;
  const { loopback } = new Voice(() => undefined, { echoes: true });
  Object.assign(loopback!.element, { play: () => Promise.reject(new Error("not allowed")) });
  connections.at(-1)!.become("connected");
  await settled();
  assert.deepEqual(ways, ["straight"]);
});
