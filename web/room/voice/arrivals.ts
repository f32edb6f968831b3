/** Whose voice does not arrive although their microphone is open: they speak, and one who listens alone would never know. */

import type { Person } from "../line/texts.js";

/** A connection takes a second or two, and finds its way again after a break of some seconds. */
export const PATIENCE_MS = 10_000;

export class Arrivals {
  private readonly since = new Map<string, number>();
  private lacking = new Map<string, string>();

  /** Look at everybody's connection; says whether it is others than before whose voice does not arrive. */
  look(others: Iterable<Person>, state: (id: string) => RTCPeerConnectionState, now: number): boolean {
    const waited = [...others].filter(
      ({ id, present, voice, muted, replayed }) => present && voice && !muted && !replayed && state(id) !== "connected",
    );
    const ids = new Set(waited.map(({ id }) => id));
    for (const id of [...this.since.keys()]) if (!ids.has(id)) this.since.delete(id);
    for (const id of ids) if (!this.since.has(id)) this.since.set(id, now);
    const before = [...this.lacking.keys()].join();
    this.lacking = new Map(waited.filter(({ id }) => now - this.since.get(id)! >= PATIENCE_MS).map(({ id, name }) => [id, name]));
    return [...this.lacking.keys()].join() !== before;
  }

  lacks(id: string): boolean {
    return this.lacking.has(id);
  }

  /** A sentence for who listens; empty where every voice arrives. */
  word(engine: boolean, ice: readonly RTCIceServer[]): string {
    if (!this.lacking.size) return "";
    const names = [...this.lacking.values()];
    const who = names.length > 3 ? `${names.length} people` : names.join(", ");
    if (engine) return `No voice arrives from ${who}; it is tried again.`;
    const relayed = ice.some(({ urls }) => [urls].flat().some((url) => /^turns?:/.test(url)));
    const way = relayed ? "not even by the room's relay; tell who runs the room." : "and the room has no relay (room serve --turn).";
    return `No voice arrives from ${who}: the networks between you let none through, ${way}`;
  }
}
