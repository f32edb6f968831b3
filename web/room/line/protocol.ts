/**
 * Writes and reads the state of one person and the tick of a room, as `room/protocol/message.py` and `tick.py` define them.
 *
 * The two languages are held equal by `room/protocol/vectors.json`.
 */

import { SHAPES } from "../../avatar/shapes.js";

export const VERSION = 1;
export const MESSAGE_BYTES = 85;
const HEAD_BYTES = 8;
/** Of a hand: its wrist's position and its rotation. */
const HAND_BYTES = 14;
/** Of any message: hands stand behind the state where flags say so. */
export const MOST_MESSAGE_BYTES = MESSAGE_BYTES + 2 * HAND_BYTES;
const KIND = 1;

/** Half degrees to a radian. */
const GAZE_STEPS = 360 / Math.PI;
const UNIT_STEPS = 32767;
const TURN_STEPS = 65536;
const UNIT_TOLERANCE = 0.01;

export const FLAG = { speaking: 1, tracked: 2, seated: 4, hands: 8 } as const;
const ALL_FLAGS = 15;

/** By their numbers on the wire; one that is not known is none. */
export const ANIMATIONS = ["none", "wave", "nod", "shake", "point", "raise hand", "clap", "pointer"] as const;
/** Shows where its person looks to all, as a dot. */
export const POINTER = ANIMATIONS.indexOf("pointer");

/** Units, frames and bounds as in Python's `Message`. */
export interface Message {
  flags: number;
  sequence: number;
  time_ms: number;
  weights: ArrayLike<number>;
  head_m: ArrayLike<number>;
  rotation: ArrayLike<number>;
  gaze: ArrayLike<number>;
  floor_m: ArrayLike<number>;
  heading: number;
  animation: number;
  /** Position of the wrist and rotation; null where it is not seen. */
  left_hand: ArrayLike<number> | null;
  right_hand: ArrayLike<number> | null;
}

export const REST: Message = {
  flags: 0,
  sequence: 0,
  time_ms: 0,
  weights: new Float64Array(SHAPES.length),
  head_m: [0, 0, 0],
  rotation: [0, 0, 0, 1],
  gaze: [0, 0, 0, 0],
  floor_m: [0, 0],
  heading: 0,
  animation: 0,
  left_hand: null,
  right_hand: null,
};

const LENGTHS = { weights: SHAPES.length, head_m: 3, rotation: 4, gaze: 4, floor_m: 2 } as const;

/** What is no message of the room. */
export class ProtocolError extends Error {
  override name = "ProtocolError";
}

/** Nearest whole number, halves up: the same in every language. */
function nearest(value: number): number {
  return Math.floor(value + 0.5);
}

function held(value: number, steps: number, least: number, most: number): number {
  return nearest(Math.min(Math.max(value * steps, least), most));
}

/** Bytes of a message with these flags. */
function size(flags: number): number {
  return flags & FLAG.hands ? MOST_MESSAGE_BYTES : MESSAGE_BYTES;
}

function checkUnit(name: string, rotation: number[]): void {
  const length = Math.hypot(...rotation);
  if (Math.abs(length - 1) > UNIT_TOLERANCE) throw new ProtocolError(`${name}: has length ${length}, and must have 1`);
}

export function encode(message: Message): Uint8Array<ArrayBuffer> {
  const hands = [message.left_hand, message.right_hand];
  const lengths = { ...LENGTHS, ...(hands[0] && { left_hand: 7 }), ...(hands[1] && { right_hand: 7 }) };
  for (const [name, length] of Object.entries(lengths) as [keyof typeof LENGTHS, number][]) {
    const numbers = message[name];
    if (numbers.length !== length) throw new ProtocolError(`${name}: has ${numbers.length} numbers, and must have ${length}`);
    if (!Array.from(numbers).every(Number.isFinite)) throw new ProtocolError(`${name}: holds a number that is not finite`);
  }
  if (!Number.isFinite(message.heading)) throw new ProtocolError("heading: is not finite");
  checkUnit("rotation", Array.from(message.rotation));
  for (const hand of hands) if (hand) checkUnit("hand", Array.from(hand).slice(3));
  if (!(message.flags >= 0 && message.flags <= ALL_FLAGS)) throw new ProtocolError(`flags: is ${message.flags}`);
  if (!(message.animation >= 0 && message.animation <= 255)) throw new ProtocolError(`animation: is ${message.animation}`);
  if (((message.flags & FLAG.hands) !== 0) !== hands.some(Boolean)) throw new ProtocolError("flags: say other than the hands");

  const content = new Uint8Array(size(message.flags));
  const view = new DataView(content.buffer);
  view.setUint8(0, VERSION);
  view.setUint8(1, message.flags);
  view.setUint16(2, message.sequence % 2 ** 16, true);
  view.setUint32(4, message.time_ms % 2 ** 32, true);
  for (let i = 0; i < SHAPES.length; i++) view.setUint8(8 + i, held(message.weights[i]!, 255, 0, 255));
  for (let i = 0; i < 3; i++) view.setInt16(60 + 2 * i, held(message.head_m[i]!, 1000, -32767, 32767), true);
  for (let i = 0; i < 4; i++) view.setInt16(66 + 2 * i, held(message.rotation[i]!, UNIT_STEPS, -32767, 32767), true);
  for (let i = 0; i < 4; i++) view.setInt8(74 + i, held(message.gaze[i]!, GAZE_STEPS, -127, 127));
  for (let i = 0; i < 2; i++) view.setInt16(78 + 2 * i, held(message.floor_m[i]!, 100, -32767, 32767), true);
  // setInt16 takes it modulo a whole turn by itself
  view.setInt16(82, nearest(((message.heading % (2 * Math.PI)) / (2 * Math.PI)) * TURN_STEPS), true);
  view.setUint8(84, message.animation);
  for (const [index, hand] of hands.entries()) {
    const at = MESSAGE_BYTES + index * HAND_BYTES;
    for (let i = 0; hand && i < 7; i++) view.setInt16(at + 2 * i, held(hand[i]!, i < 3 ? 1000 : UNIT_STEPS, -32767, 32767), true);
  }
  return content;
}

export function decode(content: Uint8Array): Message {
  if (content.length < MESSAGE_BYTES || content.length > MOST_MESSAGE_BYTES) throw new ProtocolError(`a state has no ${content.length} bytes`);
  const view = new DataView(content.buffer, content.byteOffset, content.byteLength);
  if (view.getUint8(0) !== VERSION) throw new ProtocolError(`version ${view.getUint8(0)} of a state is not known here`);
  if (view.getUint8(1) > ALL_FLAGS) throw new ProtocolError(`flags: is ${view.getUint8(1)}`);
  if (content.length !== size(view.getUint8(1))) throw new ProtocolError(`a state of these flags has no ${content.length} bytes`);
  const read = (count: number, get: (index: number) => number): number[] => Array.from({ length: count }, (_, i) => get(i));
  const rotation = read(4, (i) => view.getInt16(66 + 2 * i, true) / UNIT_STEPS);
  checkUnit("rotation", rotation);
  const [left, right] = [0, 1].map((index) => {
    const at = MESSAGE_BYTES + index * HAND_BYTES;
    if (!content.subarray(at, at + HAND_BYTES).some(Boolean)) return null;
    const hand = read(7, (i) => view.getInt16(at + 2 * i, true) / (i < 3 ? 1000 : UNIT_STEPS));
    checkUnit("hand", hand.slice(3));
    return hand;
  }) as [number[] | null, number[] | null];
  if (content.length > MESSAGE_BYTES && !left && !right) throw new ProtocolError("flags: say that a hand is seen, and none is there");
  return {
    flags: view.getUint8(1),
    sequence: view.getUint16(2, true),
    time_ms: view.getUint32(4, true),
    weights: read(SHAPES.length, (i) => view.getUint8(8 + i) / 255),
    head_m: read(3, (i) => view.getInt16(60 + 2 * i, true) / 1000),
    rotation,
    gaze: read(4, (i) => view.getInt8(74 + i) / GAZE_STEPS),
    floor_m: read(2, (i) => view.getInt16(78 + 2 * i, true) / 100),
    heading: view.getInt16(82, true) * ((2 * Math.PI) / TURN_STEPS),
    animation: view.getUint8(84),
    left_hand: left,
    right_hand: right,
  };
}

/** Time of the server in ms, and the messages in it, each behind the person's number. */
export function unpack(content: Uint8Array): { time_ms: number; states: [number, Uint8Array][] } {
  if (content.length < HEAD_BYTES) throw new ProtocolError(`a tick has at least ${HEAD_BYTES} bytes`);
  const view = new DataView(content.buffer, content.byteOffset, content.byteLength);
  if (view.getUint8(0) !== VERSION || view.getUint8(1) !== KIND) throw new ProtocolError("no tick of this version");
  const count = view.getUint16(2, true);
  const states: [number, Uint8Array][] = [];
  let at = HEAD_BYTES;
  for (let i = 0; i < count; i++) {
    if (content.length < at + 2 + MESSAGE_BYTES) throw new ProtocolError(`a tick of ${count} states ends behind ${i}`);
    const end = at + 2 + size(view.getUint8(at + 3));
    states.push([view.getUint16(at, true), content.subarray(at + 2, end)]);
    at = end;
  }
  if (at !== content.length) throw new ProtocolError(`no tick of ${count} states`);
  return { time_ms: view.getUint32(4, true), states };
}
