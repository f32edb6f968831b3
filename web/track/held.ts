/** Tells for how long what the server says of a setting is older than what was just set on this page. */

/** Enough for the server to hear of it. */
const HEARD_MS = 1000;

export class Held {
  private until = 0;

  constructor(private readonly ms = HEARD_MS) {}

  /** The setting was changed here just now. */
  hold(): void {
    this.until = performance.now() + this.ms;
  }

  /** Whether what the server says may still be older than that. */
  get on(): boolean {
    return performance.now() < this.until;
  }
}
