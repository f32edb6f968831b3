/** A line that is dead and does not say so is given up, and one that answers is kept. */

import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";

import { REST } from "../protocol.js";

/** A socket that answers nothing by itself. */
class Socket extends EventTarget {
  static readonly OPEN = 1;
  static made: Socket[] = [];
  readyState = Socket.OPEN;
  bufferedAmount = 0;
  sent: unknown[] = [];

  constructor() {
    super();
    Socket.made.push(this);
  }

  send(said: unknown): void {
    this.sent.push(said);
  }

  close(): void {
    this.readyState = 3;
  }

  say(answer: object): void {
    this.dispatchEvent(Object.assign(new Event("message"), { data: JSON.stringify(answer) }));
  }
}

const listeners = new EventTarget();
Object.assign(globalThis, { WebSocket: Socket, addEventListener: listeners.addEventListener.bind(listeners) });
const { Line } = await import("../line.js");

function comeIn(): { line: InstanceType<typeof Line>; heard: string[] } {
  const heard: string[] = [];
  const line = new Line("wss://room", { kind: "join" } as never, {
    welcome: () => heard.push("welcome"),
    answer: () => heard.push("answer"),
    state: () => undefined,
    broken: () => heard.push("broken"),
    ended: () => heard.push("ended"),
  });
  Socket.made.at(-1)!.say({ kind: "welcome" });
  return { line, heard };
}

beforeEach(() => void (Socket.made = []));

test("states that nobody answers for ten seconds end the line, and it comes back", async () => {
  const { line, heard } = comeIn();
  for (let state = 0; state < 299; state++) line.move(REST);
  assert.deepEqual(heard, ["welcome"]);
  line.move(REST);
  assert.deepEqual(heard, ["welcome", "broken"]);
  assert.equal(line.say({ kind: "leave" }), false);
  const [first] = Socket.made;
  assert.equal(first!.readyState, 3);
  await new Promise((resolve) => setTimeout(resolve, 300));
  Socket.made[1]!.say({ kind: "welcome" });
  first!.dispatchEvent(new Event("close")); // late, and of no matter
  assert.deepEqual(heard, ["welcome", "broken", "welcome"]);
  assert.equal(line.say({ kind: "leave" }), true);
});

test("a word now and then keeps the line, however slow the socket is", () => {
  const { line, heard } = comeIn();
  Socket.made[0]!.bufferedAmount = 1e6;
  for (let state = 0; state < 1000; state++) {
    if (state % 200 === 0) Socket.made[0]!.say({ kind: "door", locked: false });
    line.move(REST);
  }
  assert.equal(heard.includes("broken"), false);
});

test("another network ends a line that has been silent for a second, and no other", () => {
  const { line, heard } = comeIn();
  for (let state = 0; state < 20; state++) line.move(REST);
  listeners.dispatchEvent(new Event("online"));
  assert.deepEqual(heard, ["welcome"]);
  for (let state = 0; state < 20; state++) line.move(REST);
  listeners.dispatchEvent(new Event("online"));
  assert.deepEqual(heard, ["welcome", "broken"]);
});
