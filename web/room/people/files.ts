/** Files of avatars that people brought: fetched with the room's key, and kept while the meeting lasts. */

import { again } from "./tries.js";

/**
 * Of all together; whose was put on longest ago goes first. A server that begins anew has its people back one by one, and the
 * same files with them.
 */
export const MOST_KEPT_BYTES = 128 * 2 ** 20;

/** Files that are fetched at one time: of twenty at once over a slow link none would come for minutes. */
export const MOST_AT_ONCE = 2;

export class Files {
  private readonly kept = new Map<string, ArrayBuffer>();
  private asking = 0;
  private readonly waiting: (() => void)[] = [];

  /** `address` is `/room/NAME/avatar`. */
  constructor(
    private readonly address: string,
    private readonly key: string,
  ) {}

  /** The file of a digest, asked for until it comes; undefined where it is wanted no longer. */
  async fetch(digest: string, wanted: () => boolean): Promise<ArrayBuffer | undefined> {
    const content = this.kept.get(digest) ?? (await again(() => this.inTurn(digest, wanted), wanted));
    if (content) this.keep(digest, content);
    return content;
  }

  /** Ask when fewer than so many are on their way, if it is wanted then. */
  private async inTurn(digest: string, wanted: () => boolean): Promise<ArrayBuffer | undefined> {
    if (this.asking < MOST_AT_ONCE) this.asking++;
    else await new Promise<void>((resolve) => this.waiting.push(resolve));
    const content = wanted() ? (this.kept.get(digest) ?? (await this.ask(digest))) : undefined;
    const next = this.waiting.shift();
    if (next) next(); // has this one's turn
    else this.asking--;
    return content;
  }

  private async ask(digest: string): Promise<ArrayBuffer | undefined> {
    try {
      const answer = await fetch(`${this.address}/${digest}`, { headers: { Authorization: `Bearer ${this.key}` } });
      return answer.ok ? await answer.arrayBuffer() : undefined;
    } catch (error) {
      console.warn("an avatar that somebody brought:", error);
      return undefined;
    }
  }

  private keep(digest: string, content: ArrayBuffer): void {
    this.kept.delete(digest); // so that the newest stands last
    this.kept.set(digest, content);
    let bytes = [...this.kept.values()].reduce((sum, { byteLength }) => sum + byteLength, 0);
    for (const [oldest, { byteLength }] of this.kept) {
      if (bytes <= MOST_KEPT_BYTES) return;
      this.kept.delete(oldest);
      bytes -= byteLength;
    }
  }
}
