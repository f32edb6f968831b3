/** What a refused device means, in a sentence that says where it can be allowed. */

import assert from "node:assert/strict";
import { test } from "node:test";

Object.assign(globalThis, { self: globalThis, isSecureContext: true });
const { sentence } = await import("../door/join.js");

test("a refusal of the system, of the browser, and a device that is not there", () => {
  const says = (message: string, name: string): string => sentence(new DOMException(message, name), "load the page again");
  assert.match(says("Permission denied by system", "NotAllowedError"), /system's privacy settings, then load the page again/);
  assert.match(says("Permission denied", "NotAllowedError"), /allow it beside the address, then load the page again/);
  assert.match(says("Requested device not found", "NotFoundError"), /No such device/);
});
