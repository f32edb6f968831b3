/** One's own face for the others: by a camera, or without one by the voice, with blinks and small looks around. */

import { SHAPE_INDEX, SHAPES } from "../../avatar/index.js";

/** Angles in radians: yaw to the person's left, pitch upwards, roll towards the left shoulder. */
export interface OwnFace {
  readonly weights: Float32Array;
  readonly gaze: [number, number, number, number];
  readonly head: [yaw: number, pitch: number, roll: number];
  /** How far the head is from where it rests, metres. */
  readonly head_m: [number, number, number];
  /** Whether a camera sees it. */
  readonly tracked: boolean;
}

/**
 * A blink, and the next one after two to six seconds, as people blink. Lids stay closed for more than the time between two
 * states, or others would hardly see them meet.
 */
const BLINK_S = 0.15;
const CLOSED_S = 0.05;
const BLINK_EVERY_S = [2, 6] as const;
/** A look to another place: some degrees, every one to three seconds. */
const LOOK_EVERY_S = [1, 3] as const;
const LOOK_RAD = [0.09, 0.05] as const;
/** Level of a voice that opens the mouth wholly: -20 dB. */
const LOUD = 0.1;

const between = ([least, most]: readonly [number, number]): number => least + (most - least) * Math.random();

/** A face without a camera. */
export class Idle {
  private readonly weights = new Float32Array(SHAPES.length);
  private time = 0;
  private blinkAt = between(BLINK_EVERY_S);
  private lookAt = between(LOOK_EVERY_S);
  private look: [number, number] = [0, 0];
  private jaw = 0;

  /** `level` of the voice, 0 while nobody speaks. */
  update(seconds: number, level: number): OwnFace {
    this.time += seconds;
    if (this.time > this.blinkAt + BLINK_S) this.blinkAt = this.time + between(BLINK_EVERY_S);
    if (this.time > this.lookAt) {
      this.lookAt = this.time + between(LOOK_EVERY_S);
      this.look = [between([-1, 1]) * LOOK_RAD[0], between([-1, 1]) * LOOK_RAD[1]];
    }
    const middle = Math.abs(this.time - this.blinkAt - BLINK_S / 2);
    const closing = Math.min(1, Math.max(0, (BLINK_S / 2 - middle) / ((BLINK_S - CLOSED_S) / 2)));
    // a jaw opens faster than it closes, and a louder voice not in proportion
    const wanted = Math.min(1, Math.sqrt(level / LOUD)) * 0.6;
    this.jaw += (wanted - this.jaw) * (1 - Math.exp(-(wanted > this.jaw ? 30 : 14) * seconds));
    this.set("eyeBlinkLeft", closing);
    this.set("eyeBlinkRight", closing);
    this.set("jawOpen", this.jaw);
    this.set("mouthFunnel", 0.25 * this.jaw * (1 + Math.sin(5 * this.time)));
    this.set("mouthSmileLeft", 0.08);
    this.set("mouthSmileRight", 0.08);
    const sway = 0.012;
    return {
      weights: this.weights,
      gaze: [...this.look, ...this.look],
      head: [sway * Math.sin(0.5 * this.time), sway * Math.sin(0.8 * this.time) + 0.05 * this.jaw * Math.sin(6 * this.time), 0],
      head_m: [0.004 * Math.sin(0.6 * this.time), 0, 0],
      tracked: false,
    };
  }

  private set(name: string, weight: number): void {
    this.weights[SHAPE_INDEX.get(name)!] = weight;
  }
}
