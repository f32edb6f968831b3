/** A line that is dead and does not say so is given up, and one that answers is kept. */

import assert from "node:assert/strict";
import { beforeEach, mock, test } from "node:test";

import { REST } from "../line/protocol.js";

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

  end(): void {
    this.readyState = 3;
    this.dispatchEvent(new Event("close"));
  }

  say(answer: object): void {
    this.dispatchEvent(Object.assign(new Event("message"), { data: JSON.stringify(answer) }));
  }
}

let listeners: EventTarget;
Object.assign(globalThis, { WebSocket: Socket, addEventListener: (name: string, listener: () => void) => listeners.addEventListener(name, listener) });
let now = 0;
performance.now = () => now;
const { Line } = await import("../line/line.js");

/** Time goes on, and a state goes out each 33 ms of it. */
function move(line: InstanceType<typeof Line>, ms: number): void {
  for (let passed = 0; passed < ms; passed += 33) {
    line.move(REST);
    now += 33;
    mock.timers.tick(33);
  }
}

/** Time goes on, and timers may begin others meanwhile. */
function wait(ms: number): void {
  for (let passed = 0; passed < ms; passed += 100) mock.timers.tick(100);
}

function open(): { line: InstanceType<typeof Line>; heard: string[] } {
  const heard: string[] = [];
  const line = new Line("wss://room", { kind: "join" } as never, {
    welcome: () => heard.push("welcome"),
    answer: () => heard.push("answer"),
    state: () => undefined,
    broken: () => heard.push("broken"),
    ended: () => heard.push("ended"),
  });
  return { line, heard };
}

function comeIn(): ReturnType<typeof open> {
  const opened = open();
  Socket.made.at(-1)!.say({ kind: "welcome" });
  return opened;
}

beforeEach(() => {
  Socket.made = [];
  listeners = new EventTarget();
  mock.timers.reset();
  mock.timers.enable({ apis: ["setTimeout"] });
});

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

test("each try that fails is told, from the first one on", () => {
  const { heard } = open();
  Socket.made[0]!.end();
  assert.deepEqual(heard, ["broken"]);
  mock.timers.tick(200);
  Socket.made[1]!.end();
  assert.deepEqual(heard, ["broken", "broken"]);
});

test("what the room says of a try that it refuses is the last word of it", () => {
  const { heard } = open();
  Socket.made[0]!.say({ kind: "refused", text: "wait a moment", again: true });
  Socket.made[0]!.end();
  assert.deepEqual(heard, ["answer"]);
  mock.timers.tick(200);
  Socket.made[1]!.end();
  assert.deepEqual(heard, ["answer", "broken"]);
});

test("a try without a welcome is given up after five seconds", () => {
  const { line, heard } = open();
  wait(4900);
  assert.deepEqual(heard, []);
  wait(200);
  assert.deepEqual([heard, Socket.made[0]!.readyState], [["broken"], 3]);
  mock.timers.tick(200);
  assert.equal(Socket.made.length, 2);
  Socket.made[1]!.say({ kind: "welcome" });
  move(line, 6000);
  assert.deepEqual(heard, ["broken", "welcome"]);
});

test("behind another network a try that was begun before is made anew at once", () => {
  const { heard } = open();
  listeners.dispatchEvent(new Event("online"));
  assert.deepEqual([Socket.made.length, Socket.made[0]!.readyState], [2, 3]);
  Socket.made[0]!.end(); // late, and of no matter
  Socket.made[1]!.say({ kind: "welcome" });
  assert.deepEqual(heard, ["welcome"]);
});

test("behind another network tries are given up as soon as at the beginning", () => {
  open();
  wait(40_000); // two tries at least were given up
  listeners.dispatchEvent(new Event("online"));
  const socket = Socket.made.at(-1)!;
  wait(4900);
  assert.equal(socket.readyState, Socket.OPEN);
  wait(300);
  assert.equal(socket.readyState, 3);
});

test("each try that was given up leaves the next one more time, until there is a welcome", () => {
  const { heard } = open();
  const lasted = (): number => {
    const [socket, before] = [Socket.made.at(-1)!, heard.length];
    let ms = 0;
    for (; socket.readyState === Socket.OPEN; ms += 100) mock.timers.tick(100);
    assert.deepEqual(heard.slice(before), ["broken"]);
    wait(2000); // the next try has begun
    return Math.round(ms / 1000);
  };
  const tries = [lasted()];
  for (let number = 0; number < 3; number++) tries.push(lasted() + 2);
  assert.ok(tries.every((seconds, number) => Math.abs(seconds - [5, 9, 17, 17][number]!) <= 2), `${tries}`);
  Socket.made.at(-1)!.say({ kind: "welcome" });
  Socket.made.at(-1)!.end();
  wait(200);
  assert.equal(Math.round(lasted()), 5);
});
