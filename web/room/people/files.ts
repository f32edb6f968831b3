/** Files of avatars that people brought: fetched with the room's key, and kept while the meeting lasts. */

import { again } from "./tries.js";

/**
 * Of all together; whose was put on longest ago goes first. A server that begins anew has its people back one by one, and the
 * same files with them.
 */
export const MOST_KEPT_BYTES = 128 * 2 ** 20;

export class Files {
  private readonly kept = new Map<string, ArrayBuffer>();

  /** `address` is `/room/NAME/avatar`. */
  constructor(
    private readonly address: string,
    private readonly key: string,
  ) {}

  /** The file of a digest, asked for until it comes; undefined where it is wanted no longer. */
  async fetch(digest: string, wanted: () => boolean): Promise<ArrayBuffer | undefined> {
    const content = this.kept.get(digest) ?? (await again(() => this.ask(digest), wanted));
    if (content) this.keep(digest, content);
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
