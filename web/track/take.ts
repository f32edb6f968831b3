/** A take: what came while it was recorded, and where it is played back. */

import type { Face } from "../avatar/index.js";

/** A longer one is what recordings of `track --to csv:FILE` are for; 52 numbers at 60 a second are 9 MB by then. */
export const MOST_SECONDS = 600;

interface Kept {
  readonly seconds: number;
  readonly face: Face;
}

export class Take {
  private kept: Kept[] = [];
  private begun = 0;

  begin(now: number): void {
    this.kept = [];
    this.begun = now;
  }

  /** Whether there was room for it. */
  add(face: Face, now: number): boolean {
    const seconds = (now - this.begun) / 1000;
    if (seconds > MOST_SECONDS) return false;
    this.kept.push({ seconds, face });
    return true;
  }

  get length(): number {
    return this.kept.at(-1)?.seconds ?? 0;
  }

  /** The face of a time from the start; undefined in an empty take. */
  at(seconds: number): Face | undefined {
    let [low, high] = [0, this.kept.length - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.kept[middle]!.seconds <= seconds) low = middle;
      else high = middle - 1;
    }
    return this.kept[low]?.face;
  }
}

/** 83.4 as 1:23. */
export function clock(seconds: number): string {
  return `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;
}
