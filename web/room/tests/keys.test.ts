/** A key is the meeting's unless something else takes it: a field, the chat that it scrolls, the browser's own commands. */

import assert from "node:assert/strict";
import { test } from "node:test";

class HTMLElement {
  constructor(private readonly within: string) {}
  closest(list: string): HTMLElement | null {
    return list.split(", ").includes(this.within) ? this : null;
  }
}
Object.assign(globalThis, { HTMLElement });
const { isMeant } = await import("../keys/keys.js");

const pressed = (within: string, held: object = {}): boolean =>
  isMeant({ target: new HTMLElement(within), ctrlKey: false, metaKey: false, altKey: false, ...held } as unknown as KeyboardEvent);

test("keys on the picture and on a button are the meeting's", () => {
  for (const place of ["#view", "button", "body"]) assert.ok(pressed(place));
});

test("keys that are typed, or that scroll the chat or the list of people, are not", () => {
  for (const place of ["input", "select", "#lines", "#people"]) assert.ok(!pressed(place));
});

test("nor are those of the browser", () => {
  for (const key of ["ctrlKey", "metaKey", "altKey"]) assert.ok(!pressed("#view", { [key]: true }));
});
