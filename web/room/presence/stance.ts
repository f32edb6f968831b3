/** How one stands: seated or not, with which gesture, and the state that the others get of it. */

import type { Quaternion } from "three";

import { rotation } from "../../avatar/index.js";
import type { OwnFace } from "../face/own.js";
import { EYES_M, SEATED_M } from "../figure/body.js";
import { ANIMATIONS, FLAG, POINTER, type Message } from "../line/protocol.js";
import type { Walk } from "../scene/walk.js";

/** A gesture lasts so long; a raised hand and pointing stay until they are ended. */
const GESTURE_S = 2.2;
const STAYS = new Set(["point", "raise hand", "pointer"]);
/** How fast the eyes rise or sink to their new height, a second. */
const RISES = 8;

export class Stance {
  seated = false;
  animation = 0;
  /** Metres from the floor to the eyes. */
  eyes_m = EYES_M;
  private ends = Infinity;

  constructor(private readonly walk: Walk) {}

  /** Begin a gesture; 0 ends one. */
  gesture(number: number, now_s: number): void {
    this.animation = number;
    this.ends = number && !STAYS.has(ANIMATIONS[number]!) ? now_s + GESTURE_S : Infinity;
  }

  /** Whether the gesture has lasted long enough. */
  isOver(now_s: number): boolean {
    return now_s > this.ends;
  }

  /** Sit on the nearest seat that none of the others has taken, or stand up; false where no seat is near. */
  sit(taken: [number, number][]): boolean {
    if (!this.seated) {
      const seat = this.walk.layout.freeSeat(this.walk.x, this.walk.z, taken);
      if (!seat) return false;
      Object.assign(this.walk, seat);
    }
    this.seated = !this.seated;
    return true;
  }

  /** A headset's own room has no seats of this one: who puts it on stands. */
  stand(): void {
    this.seated = false;
  }

  /** Let the eyes rise or sink, as long as a picture takes. */
  rise(seconds: number): void {
    this.eyes_m += ((this.seated ? SEATED_M : EYES_M) - this.eyes_m) * (1 - Math.exp(-RISES * seconds));
  }

  state(face: OwnFace, speaking: boolean): Omit<Message, "sequence" | "time_ms"> {
    // who points turns the head along the ray: what others see pointed at is where the own dot is
    const [yaw, pitch, roll] = this.animation === POINTER ? [0, 0, 0] : face.head;
    const turn: Quaternion = rotation(yaw, pitch + this.walk.pitch, roll);
    return {
      flags: (speaking ? FLAG.speaking : 0) | (face.tracked ? FLAG.tracked : 0) | (this.seated ? FLAG.seated : 0),
      weights: face.weights,
      head_m: face.head_m,
      rotation: turn.toArray(),
      gaze: face.gaze,
      floor_m: [this.walk.x, this.walk.z],
      heading: this.walk.heading,
      animation: this.animation,
      left_hand: null,
      right_hand: null,
    };
  }
}
