/** Who raises a hand, for words: a list tells whoever does not see it, and a moderator is told once. */

import { ANIMATIONS, type Message } from "../line/protocol.js";
import type { Person } from "../line/texts.js";

const RAISES = ANIMATIONS.indexOf("raise hand");
/** A hand that was down for less than that has not been told anew: who waves it up and down is one. */
const AGAIN_MS = 10_000;

export class Raised {
  private readonly up = new Set<number>();
  private readonly upAt = new Map<number, number>();

  /** What a state says; "up" where there is somebody to tell of, "seen" where the list alone changes. */
  see(number: number, { animation }: Pick<Message, "animation">, now: number): "up" | "seen" | undefined {
    const [raises, before] = [animation === RAISES, this.up.has(number)];
    const last = this.upAt.get(number) ?? -Infinity;
    if (raises) this.upAt.set(number, now);
    if (raises === before) return undefined;
    this.up[raises ? "add" : "delete"](number);
    return raises && now - last > AGAIN_MS ? "up" : "seen";
  }

  /** After a break of the line: whose hand is still up says so with their next state, and is not told of anew. */
  clear(): void {
    this.up.clear();
  }

  /** Somebody has left: their number is another's next. */
  drop(number: number): void {
    this.up.delete(number);
    this.upAt.delete(number);
  }

  has({ number, present }: Pick<Person, "number" | "present">): boolean {
    return present && this.up.has(number);
  }
}
