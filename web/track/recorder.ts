/** The buttons that record a take and play it back. */

import type { Face } from "../avatar/index.js";
import { byId } from "../elements.js";
import { Held } from "./held.js";
import { clock, MOST_SECONDS, Take } from "./take.js";

export class Recorder {
  private readonly take = new Take();
  private readonly record = byId<HTMLButtonElement>("record");
  private readonly play = byId<HTMLButtonElement>("play");
  private readonly moment = byId("moment");
  private readonly slider = this.moment.querySelector("input")!;
  private readonly output = this.moment.querySelector("output")!;
  private readonly held = new Held();
  /** Whether a take is under way, for which frames have to come. */
  recording = false;
  private dragged = false;
  /** When the take's start would have been played; undefined while it is not. */
  private playedFrom: number | undefined;

  constructor(
    private readonly tell: (recording: boolean) => void,
    private readonly say: (sentence: string) => void,
  ) {
    this.record.addEventListener("click", () => {
      this.set(!this.recording);
      tell(this.recording);
    });
    this.play.addEventListener("click", () => this.playing(this.playedFrom === undefined));
    this.slider.addEventListener("input", () => this.seek(this.slider.valueAsNumber));
    this.slider.addEventListener("pointerdown", () => (this.dragged = true));
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => (this.dragged = false));
    this.slider.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (step === undefined || this.playedFrom === undefined) return;
      event.preventDefault(); // by seconds: the slider's own steps are those of frames
      this.seek(Math.min(Math.max(this.seconds(this.playedFrom) + step, 0), this.take.length));
    });
  }

  /** What the session says it does: another tab may have asked. */
  follow(recording: boolean | undefined): void {
    if (recording !== undefined && recording !== this.recording && !this.held.on) this.set(recording);
  }

  private set(recording: boolean): void {
    this.recording = recording;
    this.held.hold();
    if (recording) {
      this.playing(false);
      this.take.begin(performance.now());
    }
    this.record.classList.toggle("on", recording);
    this.play.disabled = recording || this.take.length === 0;
    this.record.querySelector("span")!.textContent = recording ? "Stop 0:00" : "Record";
  }

  private playing(on: boolean): void {
    this.playedFrom = on ? performance.now() : undefined;
    this.play.classList.toggle("on", on);
    this.play.querySelector("span")!.textContent = on ? "Back to live" : "Play back";
    this.moment.hidden = !on;
    this.slider.max = this.take.length.toFixed(2);
  }

  /** Take in what is live. */
  add(face: Face): void {
    if (!this.recording) return;
    if (!this.take.add(face, performance.now())) {
      this.set(false);
      this.tell(false);
      this.say(`A take on this page is at most ${clock(MOST_SECONDS)} long; it ended there.`);
      return;
    }
    this.record.querySelector("span")!.textContent = `Stop ${clock(this.take.length)}`;
  }

  private seek(seconds: number): void {
    this.playedFrom = performance.now() - 1000 * seconds;
  }

  /** Of a take that is played over and over. */
  private seconds(playedFrom: number): number {
    return ((performance.now() - playedFrom) / 1000) % Math.max(this.take.length, 0.1);
  }

  /** What is played just now, over and over; undefined while all is live. */
  played(): Face | undefined {
    if (this.playedFrom === undefined) return undefined;
    const seconds = this.seconds(this.playedFrom);
    if (!this.dragged) this.slider.value = `${seconds}`;
    this.slider.ariaValueText = clock(seconds);
    this.output.textContent = `${clock(seconds)} / ${clock(this.take.length)}`;
    return this.take.at(seconds);
  }
}
