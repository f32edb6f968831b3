/** Cuts the microphone's sound into frames of 20 ms for the page, also while its tab is hidden and timers are slow. */

const SAMPLES = 960;

class Frames extends AudioWorkletProcessor {
  frame = new Int16Array(SAMPLES);
  filled = 0;

  process([[channel]]) {
    for (const sample of channel ?? []) {
      this.frame[this.filled++] = Math.max(-1, Math.min(1, sample)) * 32767;
      if (this.filled === SAMPLES) {
        this.port.postMessage(this.frame, [this.frame.buffer]);
        this.frame = new Int16Array(SAMPLES);
        this.filled = 0;
      }
    }
    return true;
  }
}

registerProcessor("frames", Frames);
