/** Frames of 20 ms at 48 kHz, whatever the microphone's rate. */

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { runInNewContext } from "node:vm";

interface Processor {
  process(inputs: Float32Array[][]): boolean;
}

const SOURCE = await readFile(process.env["FRAMES"]!, "utf8");
const HUM_HERTZ = 440;

/** What the page gets of a second of a hum. */
function heard(hertz: number): number[] {
  const frames: Int16Array[] = [];
  let made: (new () => Processor) | undefined;
  class AudioWorkletProcessor {
    port = { postMessage: (frame: Int16Array) => frames.push(frame) };
  }
  const registerProcessor = (_: string, processor: new () => Processor): void => void (made = processor);
  runInNewContext(SOURCE, { sampleRate: hertz, AudioWorkletProcessor, registerProcessor, Int16Array, Math });
  const processor = new made!();
  for (let from = 0; from + 128 <= hertz; from += 128) {
    const block = Float32Array.from({ length: 128 }, (_, at) => 0.5 * Math.sin((2 * Math.PI * HUM_HERTZ * (from + at)) / hertz));
    assert.ok(processor.process([[block]]));
  }
  assert.ok(processor.process([[]])); // of a microphone that was unplugged
  return frames.flatMap((frame) => [...frame]);
}

for (const hertz of [16_000, 44_100, 48_000, 96_000]) {
  test(`a hum at ${hertz} Hz stays that hum`, () => {
    const samples = heard(hertz);
    assert.ok(samples.length >= 48_000 - 2 * 960 && samples.length <= 48_000, `${samples.length}`);
    const error = samples.map((sample, at) => Math.abs(sample / 32767 - 0.5 * Math.sin((2 * Math.PI * HUM_HERTZ * at) / 48_000)));
    assert.ok(Math.max(...error) < 0.01, `${Math.max(...error)}`);
  });
}
