/** Wakes sound that a browser has halted: before a page is touched, and on a telephone for each call that comes in. */

const MOMENTS = ["pointerdown", "pointerup", "keydown", "visibilitychange"] as const;
/** Sound that begins takes a part of that. */
const BEGINS_MS = 2000;

export class Waker {
  private haltedAt = performance.now();

  constructor(private readonly context: AudioContext) {
    context.addEventListener("statechange", this.wake);
    for (const moment of MOMENTS) addEventListener(moment, this.wake);
    this.wake();
  }

  /** What a person should know while it stays halted. */
  get word(): string {
    const stays = this.halted && performance.now() - this.haltedAt > BEGINS_MS;
    return stays ? "The browser has halted the sound; click on the page to hear the others." : "";
  }

  close(): void {
    for (const moment of MOMENTS) removeEventListener(moment, this.wake);
    void this.context.close();
  }

  /** Safari says "interrupted" of what a call has halted. */
  private get halted(): boolean {
    return this.context.state !== "running" && this.context.state !== "closed";
  }

  private readonly wake = (): void => {
    if (!this.halted) this.haltedAt = Infinity;
    else {
      this.haltedAt = Math.min(this.haltedAt, performance.now());
      void this.context.resume().catch(() => undefined); // the next touch tries again
    }
  };
}
