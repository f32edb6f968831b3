/** Who looks at a screen is called again where nothing came of a call, and let alone once it came about. */

import assert from "node:assert/strict";
import { test, mock } from "node:test";

import type { Person } from "../line/texts.js";

class Connection {
  static made: Connection[] = [];
  connectionState = "new";

  constructor() {
    Connection.made.push(this);
  }

  addTransceiver(): void {}

  close(): void {
    this.connectionState = "closed";
  }
}

const picture = { width: 4, height: 4, close: (): void => undefined } as ImageBitmap;
const track = Object.assign(new EventTarget(), { stop: (): void => undefined });
const stream = { active: true, getTracks: () => [track], getVideoTracks: () => [track] };
class HTMLCanvasElement {}
const canvas = { getContext: () => ({ drawImage: () => undefined }), captureStream: () => stream };
Object.assign(globalThis, { HTMLCanvasElement, RTCPeerConnection: Connection, document: { createElement: () => canvas } });
mock.timers.enable({ apis: ["setTimeout", "setInterval"] });
const { Sharing } = await import("../sharing/sharing.js");

const person = (id: string, shares = false): Person => ({ id, number: 1, visit: "v", present: true, shares }) as Person;

test("a word that was lost leaves nobody without a picture", () => {
  const sharing = new Sharing(
    () => undefined,
    () => undefined,
    () => undefined,
  );
  sharing.still(picture);
  sharing.meet([person("a", true), person("b")], "a");
  const states = (): string[] => Connection.made.map(({ connectionState }) => connectionState);
  mock.timers.tick(29_000);
  assert.deepEqual(states(), ["new"]);
  mock.timers.tick(2_000);
  assert.deepEqual(states(), ["closed", "new"]);
  Connection.made[1]!.connectionState = "connected";
  mock.timers.tick(100_000);
  assert.deepEqual(states(), ["closed", "connected"]);
  sharing.end();
  mock.timers.tick(100_000);
  assert.deepEqual(states(), ["closed", "closed"]);
});
