/** Cuts the microphone's sound into frames of 20 ms at 48 kHz for the page, also while its tab is hidden and timers are slow. */

const SAMPLES = 960;
/** Samples of the microphone for one of a frame; between two of them what is heard goes straight. */
const STEP = sampleRate / 48000;

class Frames extends AudioWorkletProcessor {
  frame = new Int16Array(SAMPLES);
  filled = 0;
  before = 0;
  /** Of the next one of a frame, counted from the sample before. */
  at = 1;

  process([[channel]]) {
    for (const sample of channel ?? []) {
      for (; this.at <= 1; this.at += STEP) this.push(this.before + (sample - this.before) * this.at);
      this.at -= 1;
      this.before = sample;
    }
    return true;
  }

  push(sample) {
    this.frame[this.filled++] = Math.max(-1, Math.min(1, sample)) * 32767;
    if (this.filled < SAMPLES) return;
    this.port.postMessage(this.frame, [this.frame.buffer]);
    this.frame = new Int16Array(SAMPLES);
    this.filled = 0;
  }
}

registerProcessor("frames", Frames);
