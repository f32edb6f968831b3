/** A line that is dead and does not say so is given up, and one that answers is kept. */

import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

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
let now = 0;
performance.now = () => now;
mock.timers.enable({ apis: ["setTimeout"] });
const { Line } = await import("../line.js");

/** Time goes on, and a state goes out each 33 ms of it. */
function move(line: InstanceType<typeof Line>, ms: number): void {
  for (let passed = 0; passed < ms; passed += 33) {
    line.move(REST);
    now += 33;
    mock.timers.tick(33);
  }
}

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

test("ten seconds without a word end the line, and it comes back", () => {
  const { line, heard } = comeIn();
  move(line, 9900);
  assert.deepEqual(heard, ["welcome"]);
  move(line, 200);
  assert.deepEqual(heard, ["welcome", "broken"]);
  assert.equal(line.say({ kind: "leave" }), false);
  const [first] = Socket.made;
  assert.equal(first!.readyState, 3);
  mock.timers.tick(300);
  Socket.made[1]!.say({ kind: "welcome" });
  first!.dispatchEvent(new Event("close")); // late, and of no matter
  assert.deepEqual(heard, ["welcome", "broken", "welcome"]);
  assert.equal(line.say({ kind: "leave" }), true);
});

test("a word now and then keeps the line, however slow the socket is", () => {
  const { line, heard } = comeIn();
  Socket.made[0]!.bufferedAmount = 1e6;
  for (let word = 0; word < 5; word++) {
    Socket.made[0]!.say({ kind: "door", locked: false });
    move(line, 8000);
  }
  assert.equal(heard.includes("broken"), false);
});

test("a page that was halted for an hour sends before it gives a line up", () => {
  const { line, heard } = comeIn();
  line.move(REST);
  now += 3_600_000;
  line.move(REST);
  Socket.made[0]!.say({ kind: "door", locked: false });
  move(line, 5000);
  assert.deepEqual(heard, ["welcome", "answer"]);
});

test("behind another network a second of silence ends a line, and a word keeps it", () => {
  const { line, heard } = comeIn();
  move(line, 500);
  listeners.dispatchEvent(new Event("online"));
  move(line, 500);
  Socket.made[0]!.say({ kind: "door", locked: false });
  move(line, 1000);
  assert.deepEqual(heard, ["welcome", "answer"]);
  listeners.dispatchEvent(new Event("online"));
  move(line, 900);
  assert.deepEqual(heard, ["welcome", "answer"]);
  move(line, 200);
  assert.deepEqual(heard, ["welcome", "answer", "broken"]);
});
