/**
 * Shows one person's states smoothly: by the sender's own times, a little late, however they arrive.
 *
 * The delay follows how unevenly messages come: it grows at once when one is late and shrinks slowly, within bounds.
 */

import { FLAG, REST, type Message } from "../line/protocol.js";

/** At the least, one message lies ahead of what is shown: 33 ms, and half as much for the timers of browsers. */
const LEAST_DELAY_MS = 50;
/** Beyond this a face is so far behind its voice that a jump is better. */
const MOST_DELAY_MS = 400;
/** Of what the delay is larger than needed, given back each second. */
const SHRINK_PER_S = 0.2;
/** Longer silence is no lost message: the face goes to rest. A browser lets a page that nobody sees speak once a second. */
export const STALE_MS = 1600;
/** A face is at rest so much later. */
const FADE_MS = 600;
/** Two messages that are further apart are not blended: somebody came back. */
const GAP_MS = 1500;
/** A message that is so much earlier or later than the others was made by another clock. */
const OTHER_CLOCK_MS = 1500;
/** States that are kept: a second and a half. */
const MOST_KEPT = 48;

interface Arrived {
  readonly at: number; // by the sender's clock, unwrapped
  readonly message: Message;
}

export class Playback {
  private readonly kept: Arrived[] = [];
  private epoch = 0;
  private lastTime: number | undefined;
  /** Least difference of arrival and sending seen lately: a message that was not held up. */
  private offset = Infinity;
  private delay = LEAST_DELAY_MS;
  private heard = -Infinity;
  private shown = -Infinity;

  /** How far what is shown lies behind the newest, in ms. */
  get delayMs(): number {
    return this.delay;
  }

  /** Take a message that arrived now, in ms of the page's clock. */
  push(message: Message, now: number): void {
    const at = this.unwrapped(message.time_ms);
    const transit = now - at;
    // another clock, of a program or of a page that was loaded anew; or a line that stood still for as long
    if (Math.abs(transit - this.offset) > OTHER_CLOCK_MS) this.restart();
    if (this.kept.some((other) => other.at === at)) return; // the same again
    this.heard = now;
    // clocks drift by some 50 ppm: the least transit is forgotten slowly, or a slow clock would count as lateness
    this.offset = Math.min(transit, this.offset + 0.05);
    const needed = transit - this.offset + LEAST_DELAY_MS;
    this.delay = Math.min(Math.max(this.delay, needed), MOST_DELAY_MS);
    let place = this.kept.length;
    while (place > 0 && this.kept[place - 1]!.at > at) place--;
    this.kept.splice(place, 0, { at, message });
    if (this.kept.length > MOST_KEPT) this.kept.shift();
  }

  /** What to show now, in ms of the page's clock; undefined before the first message. */
  at(now: number): Message | undefined {
    const newest = this.kept.at(-1);
    if (!newest) return undefined;
    if (this.shown > -Infinity) {
      const seconds = Math.max(0, now - this.shown) / 1000;
      this.delay = Math.max(LEAST_DELAY_MS, this.delay - (this.delay - LEAST_DELAY_MS) * Math.min(1, SHRINK_PER_S * seconds));
    }
    this.shown = now;
    const silent = now - this.heard;
    const time = now - this.offset - this.delay;
    const message = this.between(time);
    return silent > STALE_MS ? aged(message, Math.min(1, (silent - STALE_MS) / FADE_MS)) : message;
  }

  private between(time: number): Message {
    const after = this.kept.findIndex(({ at }) => at > time);
    if (after === -1) return this.kept.at(-1)!.message;
    if (after === 0) return this.kept[0]!.message;
    const [from, to] = [this.kept[after - 1]!, this.kept[after]!];
    if (to.at - from.at > GAP_MS) return from.message;
    return blend(from.message, to.message, (time - from.at) / (to.at - from.at));
  }

  /** The sender's clock without its wrap at 2^32 ms. */
  private unwrapped(time: number): number {
    if (this.lastTime !== undefined) {
      const step = time - this.lastTime;
      if (step < -(2 ** 31)) this.epoch += 2 ** 32;
      else if (step > 2 ** 31) this.epoch -= 2 ** 32;
    }
    this.lastTime = time;
    return this.epoch + time;
  }

  /** Forget the old clock: another one has taken over. */
  restart(): void {
    this.kept.length = 0;
    this.offset = Infinity;
    this.delay = LEAST_DELAY_MS;
  }
}

/** A state between two; flags and gestures are those of the one that is nearer in the past. */
export function blend(from: Message, to: Message, share: number): Message {
  const mix = (a: ArrayLike<number>, b: ArrayLike<number>): number[] => Array.from(a, (value, i) => value + (b[i]! - value) * share);
  // the shorter way round, and back to length 1: two messages are at most some degrees apart
  const mixTurn = (a: ArrayLike<number>, b: ArrayLike<number>): number[] => {
    const dot = Array.from(a).reduce((sum, value, i) => sum + value * b[i]!, 0);
    const mixed = mix(a, dot < 0 ? Array.from(b, (value) => -value) : b);
    const length = Math.hypot(...mixed) || 1;
    return mixed.map((value) => value / length);
  };
  const near = share < 1 ? from : to;
  // a hand that one of the two does not know comes or goes at once: the figure makes that smooth
  const hand = (name: "left_hand" | "right_hand"): Message["left_hand"] => {
    const [a, b] = [from[name] && Array.from(from[name]), to[name] && Array.from(to[name])];
    return a && b ? [...mix(a.slice(0, 3), b.slice(0, 3)), ...mixTurn(a.slice(3), b.slice(3))] : near[name];
  };
  const turn = Math.atan2(Math.sin(to.heading - from.heading), Math.cos(to.heading - from.heading));
  return {
    ...near,
    weights: mix(from.weights, to.weights),
    head_m: mix(from.head_m, to.head_m),
    rotation: mixTurn(from.rotation, to.rotation),
    gaze: mix(from.gaze, to.gaze),
    floor_m: mix(from.floor_m, to.floor_m),
    heading: from.heading + turn * share,
    left_hand: hand("left_hand"),
    right_hand: hand("right_hand"),
  };
}

/** A face on its way to rest; the body stays where it stood. */
function aged(message: Message, share: number): Message {
  const rest = { ...REST, floor_m: message.floor_m, heading: message.heading, flags: message.flags & FLAG.seated };
  return { ...blend(message, rest, share), flags: rest.flags, animation: 0, left_hand: null, right_hand: null };
}
