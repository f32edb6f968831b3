/** Notices can be read, whatever a camera has to say meanwhile, and the last word of a meeting stays. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { NOTICE_MS, Status } from "../page/status.js";

const FRAME_MS = 33;

test("a notice outlasts what a camera says thirty times a second, and then gives way to it", () => {
  const line = { textContent: "" };
  let camera = "";
  const status = new Status(line, () => [camera, "voices are away"]);
  status.tell("locked", 1000);
  for (let now = 1000; now < 1000 + NOTICE_MS; now += FRAME_MS) {
    camera = now % 2 ? "no face" : "";
    status.show(now);
    assert.equal(line.textContent, "locked");
  }
  camera = "no face";
  status.show(1000 + NOTICE_MS);
  assert.equal(line.textContent, "no face");
  camera = "";
  status.show(1000 + NOTICE_MS);
  assert.equal(line.textContent, "voices are away");
});

test("the newest notice counts, and an empty one takes it back", () => {
  const line = { textContent: "" };
  const status = new Status(line, () => []);
  status.tell("first", 0);
  status.tell("second", NOTICE_MS - 1);
  status.show(NOTICE_MS + 1);
  assert.equal(line.textContent, "second");
  status.tell("", NOTICE_MS + 2);
  assert.equal(line.textContent, "");
});

test("what is held stays until something else is said", () => {
  const line = { textContent: "" };
  const status = new Status(line, () => ["no face"]);
  status.hold("broken", 0);
  status.show(100 * NOTICE_MS);
  assert.equal(line.textContent, "broken");
  status.tell("", 101 * NOTICE_MS);
  assert.equal(line.textContent, "no face");
});

test("nothing is said after the last word", () => {
  const line = { textContent: "" };
  const status = new Status(line, () => ["no face"]);
  status.end("refused", 0);
  status.tell("No camera", 1);
  status.show(100 * NOTICE_MS);
  assert.equal(line.textContent, "refused");
});

test("a line that says the same is left alone", () => {
  let writes = 0;
  const line = {
    text: "",
    get textContent(): string {
      return this.text;
    },
    set textContent(text: string) {
      this.text = text;
      writes += 1;
    },
  };
  const status = new Status(line, () => ["no face"]);
  for (let now = 0; now < 10; now += 1) status.show(now);
  assert.equal(writes, 1);
});
