/** Whom a moderator acts on is told, and what one does oneself is no news. */

import assert from "node:assert/strict";
import { test } from "node:test";

import type { Person } from "../line/texts.js";
import { newsOf } from "../page/news.js";

const ada = { number: 1, id: "a", name: "Ada", muted: false, own: "d".repeat(64), shares: true } as Person;
const wants = { shares: true, wears: true };

test("who is muted, undressed or cut short is told so", () => {
  assert.match(newsOf(ada, { ...ada, muted: true, shares: false }, wants), /muted you/);
  assert.match(newsOf({ ...ada, muted: true }, ada, wants), /speak again/);
  assert.match(newsOf(ada, { ...ada, own: "" }, wants), /avatar off/);
  assert.match(newsOf(ada, { ...ada, shares: false }, wants), /ended your sharing/);
});

test("who loses their name to a moderator is told so", () => {
  assert.match(newsOf(ada, { ...ada, name: "Ada 2" }, wants), /you as Ada 2/);
});

test("what one did oneself is no news", () => {
  assert.equal(newsOf(ada, { ...ada, own: "", shares: false }, { shares: false, wears: false }), "");
  assert.equal(newsOf(ada, { ...ada, voice: true }, wants), "");
});
