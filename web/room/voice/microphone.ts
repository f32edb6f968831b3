/** The microphone: its sound for the others, its level for the person, and whether somebody speaks into it. */

import makeFvad from "@echogarden/fvad-wasm";

import { Waker } from "./waker.js";

/** Frames of 20 ms; voiced ones of the last five that turn the sign on, and how long it stays behind the last one. */
const FRAMES = 5;
const VOICED = 3;
export const HANG_MS = 400;
/** Frames that stay away for so long do not come for now: somebody's last word is over. */
const SILENT_MS = 500;
/** fvad's strictest: noise is a voice least often. */
const MODE = 3;
const FRAME_SAMPLES = 960;
const HERTZ = 48000;

/** Whether somebody speaks, by which frames are voiced: a click is not speech, and a breath between words is no end. */
export class SpeakingSign {
  private readonly recent: boolean[] = [];
  private lastVoiced = -Infinity;

  hear(voiced: boolean, now: number): boolean {
    this.recent.push(voiced);
    if (this.recent.length > FRAMES) this.recent.shift();
    if (this.recent.filter(Boolean).length >= VOICED) this.lastVoiced = now;
    return now - this.lastVoiced < HANG_MS;
  }
}

export class Microphone {
  /** Of the last 20 ms, 0 to 1 (0 dB). */
  level = 0;
  /** Whether it was unplugged, or taken away by the system. */
  gone = false;
  /** Called when it goes. */
  onGone = (): void => undefined;
  private readonly sign = new SpeakingSign();
  private readonly waker: Waker;
  private spoke = false;
  private heardAt = -Infinity;
  private open = true;

  private constructor(
    readonly stream: MediaStream,
    context: AudioContext,
    node: AudioWorkletNode,
    private readonly isVoice: (frame: Int16Array) => boolean,
  ) {
    this.waker = new Waker(context);
    node.port.onmessage = ({ data }: MessageEvent<Int16Array>) => this.hear(data);
    for (const track of stream.getAudioTracks()) {
      track.addEventListener("ended", () => {
        this.gone = true;
        this.isOpen = false;
        this.onGone();
      });
    }
  }

  /** What a person should know of it for as long as it is so. */
  get word(): string {
    return this.gone ? "Your microphone is gone; plug it in and load the page again." : "";
  }

  /** Ask for a microphone; throws what the browser says where there is none, or the person refuses. */
  static async ask(device: string | undefined): Promise<Microphone> {
    const stream = await navigator.mediaDevices.getUserMedia({
      audio: { echoCancellation: true, noiseSuppression: true, autoGainControl: true, ...(device ? { deviceId: device } : {}) },
    });
    // of the microphone's own rate: Firefox joins no others; the worklet makes 48 kHz of it
    const context = new AudioContext();
    try {
      await context.audioWorklet.addModule("/static/frames.worklet.js");
      const node = new AudioWorkletNode(context, "frames", { numberOfOutputs: 0 });
      context.createMediaStreamSource(stream).connect(node);
      return new Microphone(stream, context, node, await detector());
    } catch (error) {
      for (const track of stream.getTracks()) track.stop(); // or the browser shows that it listens
      void context.close();
      throw error;
    }
  }

  get speaking(): boolean {
    return this.spoke && performance.now() - this.heardAt < SILENT_MS;
  }

  get isOpen(): boolean {
    return this.open;
  }

  set isOpen(open: boolean) {
    this.open = open;
    for (const track of this.stream.getAudioTracks()) track.enabled = open;
    if (!open) this.spoke = false;
  }

  close(): void {
    for (const track of this.stream.getTracks()) track.stop();
    this.waker.close();
  }

  private hear(frame: Int16Array): void {
    this.heardAt = performance.now();
    const energy = frame.reduce((sum, sample) => sum + sample * sample, 0) / frame.length;
    this.level = Math.sqrt(energy) / 32768;
    if (!this.open) return;
    this.spoke = this.sign.hear(this.isVoice(frame), this.heardAt);
  }
}

/** WebRTC's voice activity detection. */
async function detector(): Promise<(frame: Int16Array) => boolean> {
  const fvad = await makeFvad({ locateFile: () => "/static/fvad.wasm" });
  const state = fvad._fvad_new();
  fvad._fvad_set_mode(state, MODE);
  fvad._fvad_set_sample_rate(state, HERTZ);
  const place = fvad._malloc(2 * FRAME_SAMPLES);
  return (frame) => {
    fvad.HEAP16.set(frame, place / 2);
    return fvad._fvad_process(state, place, frame.length) === 1;
  };
}
