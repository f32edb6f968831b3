/** The bar of a replay: where it is, halt and go on, a jump, a pace; by mouse and by keys. All who look see the same. */

import { byId } from "../../elements.js";
import { isMeant } from "../keys/keys.js";
import { openByKeys } from "../keys/lists.js";
import type { Said } from "../line/texts.js";

export type Playing = { kind: "playing"; time_s: number; length_s: number; paused: boolean; speed: number };
type Ask = Omit<Extract<Said, { kind: "play" }>, "kind">;

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8];
/** A key jumps so far. */
const JUMP_S = 5;
/** While the slider is dragged, or a key is held, so often; the server takes five a second. */
const OFTEN_MS = 250;
/** So long the slider waits where it was moved to until the room is there. */
const WAITS_MS = 1000;

export class Replaying {
  private playing: Playing | undefined;
  private heardAt = 0;
  private askedAt = -Infinity;
  /** Where it was moved to. */
  private wanted: number | undefined;
  private later = 0;
  private dragging = false;
  private pointed = false;
  private readonly bar = byId("replay");
  private readonly halt = byId<HTMLButtonElement>("halt");
  private readonly slider = byId<HTMLInputElement>("moment");
  private readonly pace = byId<HTMLSelectElement>("pace");

  constructor(private readonly say: (said: Extract<Said, { kind: "play" }>) => void) {
    this.pace.replaceChildren(...SPEEDS.map((speed) => new Option(`${speed} ×`, String(speed))));
    this.halt.addEventListener("click", () => this.toggle());
    this.slider.addEventListener("pointerdown", () => (this.pointed = true));
    this.slider.addEventListener("keydown", () => (this.pointed = false));
    this.slider.addEventListener("input", () => {
      this.dragging = true;
      this.seek(this.slider.valueAsNumber);
    });
    this.slider.addEventListener("change", () => {
      this.dragging = false;
      this.seek(this.slider.valueAsNumber);
      if (this.pointed) this.slider.blur(); // arrows walk again; who came by keys goes on by keys
    });
    openByKeys(this.pace);
    this.pace.addEventListener("change", () => {
      this.ask({ speed: Number(this.pace.value) });
      this.pace.blur();
    });
    addEventListener("keydown", (event) => this.key(event));
  }

  /** What the room says; the first word shows the bar. */
  hear(playing: Playing): void {
    this.playing = playing;
    this.heardAt = performance.now();
    if (!this.later) this.wanted = undefined;
    this.bar.hidden = false;
    this.halt.textContent = playing.paused ? "Play" : "Pause";
    this.slider.max = String(playing.length_s);
    this.pace.value = String(playing.speed);
    this.show();
  }

  /** Seconds from the beginning, by the last word and the time since. */
  get time(): number {
    if (!this.playing) return 0;
    const { time_s, length_s, paused, speed } = this.playing;
    return Math.min(length_s, time_s + (paused ? 0 : (speed * (performance.now() - this.heardAt)) / 1000));
  }

  /** Once a picture. */
  show(): void {
    if (!this.playing) return;
    const waits = this.later !== 0 || performance.now() - this.askedAt < WAITS_MS;
    if (!this.dragging) this.slider.value = String((waits ? this.wanted : undefined) ?? this.time);
    const text = `${clock(this.slider.valueAsNumber)} / ${clock(this.playing.length_s)}`;
    const shown = byId("clock");
    if (shown.textContent !== text) {
      shown.textContent = text;
      this.slider.setAttribute("aria-valuetext", text);
    }
  }

  private toggle(): void {
    this.ask({ paused: !this.playing!.paused });
  }

  private key(event: KeyboardEvent): void {
    const { key, repeat, target } = event;
    if (!this.playing || !isMeant(event)) return;
    if (repeat && performance.now() - this.askedAt < OFTEN_MS) return;
    if (key === " " && target instanceof HTMLButtonElement) return; // it presses that one
    const faster = SPEEDS.find((speed) => speed > this.playing!.speed);
    const slower = SPEEDS.filter((speed) => speed < this.playing!.speed).at(-1);
    if (key === " " || key === "k") {
      if (!repeat) this.toggle();
    } else if (key === "j") this.ask({ time_s: Math.max(0, this.time - JUMP_S) });
    else if (key === "l") this.ask({ time_s: Math.min(this.playing.length_s, this.time + JUMP_S) });
    else if (key === "Home") this.ask({ time_s: 0 });
    else if (key === ">" && faster) this.ask({ speed: faster });
    else if (key === "<" && slower) this.ask({ speed: slower });
    else return;
    event.preventDefault();
  }

  /** Ask for a moment as often as the server takes it: of many it is the last one that counts. */
  private seek(time_s: number): void {
    clearTimeout(this.later);
    this.wanted = time_s;
    const wait = this.askedAt + OFTEN_MS - performance.now();
    this.later = wait > 0 ? window.setTimeout(() => this.seek(time_s), wait) : 0;
    if (!this.later) this.ask({ time_s });
  }

  private ask(said: Ask): void {
    this.askedAt = performance.now();
    this.say({ kind: "play", ...said });
  }
}

function clock(seconds: number): string {
  const whole = Math.floor(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}
