/** A hand that goes up is told once, and whoever plays with it is not told again and again. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { ANIMATIONS, type Message } from "../line/protocol.js";
import { Raised } from "../page/raised.js";

const shows = (name: string): Pick<Message, "animation"> => ({ animation: ANIMATIONS.indexOf(name as never) });
const ada = { number: 3, present: true };

test("a hand is told as it goes up, and stays in the list until it goes down", () => {
  const raised = new Raised();
  assert.equal(raised.see(3, shows("clap"), 0), undefined);
  assert.equal(raised.has(ada), false);
  assert.equal(raised.see(3, shows("raise hand"), 1000), "up");
  assert.equal(raised.see(3, shows("raise hand"), 1033), undefined);
  assert.deepEqual([raised.has(ada), raised.has({ ...ada, present: false }), raised.has({ ...ada, number: 4 })], [true, false, false]);
  assert.equal(raised.see(3, shows("none"), 60_000), "seen");
  assert.equal(raised.has(ada), false);
});

test("who waves a hand up and down is told once", () => {
  const raised = new Raised();
  const said = Array.from({ length: 300 }, (_, step) => raised.see(3, shows(step % 2 ? "none" : "raise hand"), step * 100));
  assert.equal(said.filter((word) => word === "up").length, 1);
  assert.equal(raised.see(3, shows("raise hand"), 60_000), "up");
});

test("behind a break of the line a hand that went down meanwhile is down, and one that is up is not told again", () => {
  const raised = new Raised();
  raised.see(3, shows("raise hand"), 0);
  raised.see(4, shows("raise hand"), 0);
  raised.clear();
  assert.equal(raised.see(3, shows("none"), 2000), undefined);
  assert.equal(raised.see(4, shows("raise hand"), 2000), "seen");
  assert.deepEqual([raised.has(ada), raised.has({ ...ada, number: 4 })], [false, true]);
});

test("a number that is another's next begins anew", () => {
  const raised = new Raised();
  raised.see(3, shows("raise hand"), 0);
  raised.drop(3);
  assert.equal(raised.has(ada), false);
  assert.equal(raised.see(3, shows("raise hand"), 100), "up");
});
