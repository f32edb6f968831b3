/** Oneself in the room: where one stands, how one looks by a camera or without, and what one hears from there. */

import { FaceCamera } from "../face/face.js";
import { Idle } from "../face/own.js";
import { EYES_M, SEATED_M } from "../figure/body.js";
import { FLAG, type Message } from "../line/protocol.js";
import type { Known } from "../people/people.js";
import type { Place } from "../scene/place.js";
import type { View } from "../scene/view.js";
import { Walk } from "../scene/walk.js";
import type { Microphone } from "../voice/microphone.js";
import type { Voice } from "../voice/voice.js";
import { Headset } from "./headset.js";
import { Stance } from "./stance.js";

/** The last states of all come right behind the welcome; a newcomer waits so long to see who stands where. */
const FIRST_TICK_MS = 150;

type State = Omit<Message, "sequence" | "time_ms">;

export class Presence {
  readonly walk: Walk;
  readonly stance: Stance;
  readonly headset: Headset;
  /** The newest state that was sent. */
  sent: Message | undefined;
  /** Whether one stands somewhere. */
  placed = false;
  camera: FaceCamera | undefined;
  private readonly idle = new Idle();
  private placedBy = Infinity;
  private ended = false;
  private strolled = performance.now();
  private moved = performance.now();

  /** `canvas` is what is walked on and `button` puts a headset on. */
  constructor(
    canvas: HTMLElement,
    button: HTMLButtonElement,
    view: View,
    private readonly place: Place,
    private readonly microphone: Microphone | undefined,
    tell: (text: string) => void,
  ) {
    this.walk = new Walk(canvas, place.layout);
    this.stance = new Stance(this.walk);
    this.headset = new Headset(view.renderer, view.rig, this.walk, button, tell, () => this.stance.stand());
  }

  /** Let a camera see one's face, and say whether it does; throws where there is none. */
  async watch(): Promise<boolean> {
    const camera = await FaceCamera.ask();
    if (this.ended) camera.close(); // the meeting was over before the browser, or its person, gave it
    else this.camera = camera;
    return !this.ended;
  }

  /** Nobody sees one any more. */
  end(): void {
    this.ended = true;
    this.camera?.close();
    this.camera = undefined;
    this.headset.leave();
  }

  /** The room has let one in; the others' places come next. */
  arrive(now: number): void {
    this.placedBy = now + FIRST_TICK_MS;
  }

  /** The page was loaded anew: one stands where one stood. */
  resume({ floor_m, heading }: Message): void {
    if (this.placed) return;
    Object.assign(this.walk, { x: floor_m[0]!, z: floor_m[1]!, heading });
    this.placed = true;
  }

  /** Find a place that is free, once it is known where the others are; says whether one stands. */
  stand(now: number, taken: [number, number][], replay?: boolean): boolean {
    if (!this.placed && now > this.placedBy) {
      Object.assign(this.walk, this.place.layout.freePlace(taken, replay));
      this.placed = true;
    }
    return this.placed;
  }

  /** Sit down on a seat that is near, or stand up; says why not. */
  sit(taken: [number, number][]): string {
    if (this.headset.worn) return "Take the headset off to sit on a seat of the room.";
    return this.stance.sit(taken) ? "" : "No free seat is near; walk to one.";
  }

  /** How one looks and where one stands by now, for the others. */
  move(now: number): State {
    const seconds = Math.min(0.2, (now - this.moved) / 1000);
    this.moved = now;
    this.stroll(now);
    const speaking = this.microphone?.speaking ?? false;
    const idle = this.idle.update(seconds, speaking ? this.microphone!.level : 0);
    const state = { ...this.stance.state(this.camera?.face(now) ?? idle, speaking), ...this.headset.update(seconds) };
    if (state.left_hand ?? state.right_hand) state.flags |= FLAG.hands;
    this.sent = { ...state, sequence: 0, time_ms: 0, weights: Float64Array.from(state.weights) };
    return state;
  }

  /** Put voices and ears where heads are; not with the pictures, as voices of a hidden tab go on. */
  listen(voice: Voice, others: readonly Known[], now: number): void {
    for (const { person, playback } of others) {
      const shown = playback.at(now);
      if (!shown) continue;
      const height = shown.flags & FLAG.seated ? SEATED_M : EYES_M;
      voice.place(person.id, { x: shown.floor_m[0]!, y: height, z: shown.floor_m[1]! });
    }
    const { x, z, heading } = this.walk;
    const { at, heading: turned } = this.headset.ears() ?? { at: { x, y: this.stance.eyes_m, z }, heading };
    voice.listen(at, turned);
  }

  /** Look from one's eyes, which rise, sink and walk as long as a picture takes. */
  look(view: View, seconds: number): void {
    this.stroll(performance.now());
    this.stance.rise(seconds);
    this.headset.look();
    view.look(this.walk.x, this.walk.z, this.stance.eyes_m, this.walk.heading, this.walk.pitch);
  }

  /** Walk on to this moment: with each picture, and where a page shows none with each state. */
  private stroll(now: number): void {
    const seconds = Math.max(0, Math.min(0.2, (now - this.strolled) / 1000));
    this.strolled = now;
    if (this.headset.worn) this.headset.steer(seconds);
    else this.walk.update(seconds, this.stance.seated);
  }
}
