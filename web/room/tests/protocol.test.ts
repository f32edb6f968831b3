/** Runs the vectors that Python made. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { decode, encode, ProtocolError, REST, unpack, type Message } from "../line/protocol.js";

const vectors = JSON.parse(readFileSync(process.env["VECTORS"]!, "utf8"));
const number = (value: unknown): unknown =>
  Array.isArray(value) ? value.map(number) : typeof value === "string" ? { nan: NaN, inf: Infinity, "-inf": -Infinity }[value] : value;
const fields = (state: object): Message =>
  ({ ...REST, ...Object.fromEntries(Object.entries(state).map(([name, value]) => [name, number(value)])) }) as Message;
const bytes = (hex: string): Uint8Array => Uint8Array.from(Buffer.from(hex, "hex"));
const hex = (content: Uint8Array): string => Buffer.from(content).toString("hex");

test("there are vectors", () => {
  assert.ok(vectors.states.length > 8 && vectors.refused_states.length > 8 && vectors.ticks.length > 3);
});

for (const { name, state, hex: expected, read } of vectors.states) {
  test(`state: ${name}`, () => {
    assert.equal(hex(encode(fields(state))), expected);
    assert.deepEqual(decode(bytes(expected)), read);
  });
}

for (const { name, state } of vectors.refused_states) {
  test(`refused state: ${name}`, () => assert.throws(() => encode(fields(state)), ProtocolError));
}

for (const { name, hex: content } of vectors.refused_messages) {
  test(`refused message: ${name}`, () => assert.throws(() => decode(bytes(content)), ProtocolError));
}

for (const { name, time_ms, states, hex: content } of vectors.ticks) {
  test(`tick: ${name}`, () => {
    const read = unpack(bytes(content));
    assert.equal(read.time_ms, time_ms);
    assert.deepEqual(read.states.map(([person, state]) => [person, hex(state)]), states);
    assert.throws(() => unpack(bytes(content).subarray(1)), ProtocolError);
    assert.throws(() => unpack(new Uint8Array([...bytes(content), 0])), ProtocolError);
  });
}
