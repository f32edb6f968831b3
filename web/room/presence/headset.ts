/** A headset in the page (WebXR): the head moves the body, its ears hear, sticks walk and turn in steps that spare the stomach. */

import { Matrix4, Quaternion, Vector3, type Group, type WebGLRenderer } from "three";

import type { Message } from "../line/protocol.js";
import type { Walk } from "../scene/walk.js";
import type { Position } from "../voice/sound.js";
import { wristOf } from "./hands.js";

/** A turn by a stick: at once, as slow turns make many people sick. */
const SNAP = Math.PI / 6;
/** A stick beyond the first turns once; below the second it may turn again. */
const [PUSHED, RELEASED] = [0.7, 0.3];
/** Sticks rest a little off their middle. */
const DEAD = 0.15;
/** Metres a second, as by keys. */
const PACE = 1.4;
/** A body follows its head round by this share of the way each second, as a rate. */
const FOLLOWS = 1.5;
/** Of a standard gamepad for XR: the stick's axes. */
const STICK = { x: 2, y: 3 } as const;

const UP = new Vector3(0, 1, 0);

type Worn = Pick<Message, "floor_m" | "heading" | "rotation" | "head_m" | "left_hand" | "right_hand">;

export class Headset {
  private session: XRSession | undefined;
  private over = false;
  /** Whether the browser asks. */
  private entering = false;
  /** Turn of the body in the room that the headset knows, whose zero is where it looked first. */
  private body = 0;
  private rest: number | undefined;
  private turned = false;
  /** Of the head between the eyes, as the headset told last. */
  private readonly head = new Vector3();
  private readonly headTurn = new Quaternion();
  /** Of both wrists, as the headset told last. */
  private hands: Partial<Record<XRHandedness, Matrix4 | undefined>> = {};
  private readonly ahead = new Vector3();
  private readonly turn = new Quaternion();

  /** `rig` carries the camera of the page: it stands where the headset's own room has its middle. */
  constructor(
    private readonly renderer: WebGLRenderer,
    private readonly rig: Group,
    private readonly walk: Walk,
    private readonly button: HTMLButtonElement,
    private readonly tell: (text: string) => void,
    /** Called as one begins to look through the headset. */
    private readonly begun: () => void,
  ) {
    button.addEventListener("click", () => void (this.session ? this.session.end() : this.enter()));
    // the button is there only where a headset is
    void navigator.xr?.isSessionSupported("immersive-vr").then((supported) => (button.hidden = !supported || this.over));
  }

  /** The meeting is over: nothing is left to be seen in a headset. */
  leave(): void {
    this.over = true;
    this.button.hidden = true;
    void this.session?.end();
  }

  get worn(): boolean {
    return this.session !== undefined;
  }

  /** Where the ears are, and where they point; undefined without a headset. */
  ears(): { at: Position; heading: number } | undefined {
    if (!this.session) return undefined;
    const [x, z] = this.floor();
    return { at: { x, y: this.head.y, z }, heading: this.walk.heading + this.yaw() };
  }

  /** Take over where head and hands are; in each picture, as a headset tells it then alone. */
  look(): void {
    const space = this.renderer.xr.getReferenceSpace();
    const frame = this.renderer.xr.getFrame();
    const pose = space && this.session && frame?.getViewerPose?.(space);
    if (!pose) return;
    this.hands = {};
    for (const source of this.session!.inputSources) this.hands[source.handedness] ??= wristOf(source, frame, space);
    const { position, orientation } = pose.transform;
    this.head.set(position.x, position.y, position.z);
    this.headTurn.set(orientation.x, orientation.y, orientation.z, orientation.w);
    this.rest ??= position.y;
  }

  /** Walk and turn by sticks; as often as pictures come, or the world would jerk. */
  steer(seconds: number): void {
    if (!this.session || this.rest === undefined) return;
    for (const { gamepad, handedness } of this.session.inputSources) {
      const [x, y] = [gamepad?.axes[STICK.x] ?? 0, gamepad?.axes[STICK.y] ?? 0];
      if (handedness === "right") this.snap(x);
      else this.stride(x, y, seconds);
    }
    this.carry();
  }

  /** How the body stands, which turns after the head; undefined without a headset. */
  update(seconds: number): Worn | undefined {
    if (!this.session || this.rest === undefined) return undefined;
    const off = this.yaw() - this.body;
    this.body += Math.atan2(Math.sin(off), Math.cos(off)) * (1 - Math.exp(-FOLLOWS * seconds));
    this.turn.setFromAxisAngle(UP, -this.body).multiply(this.headTurn);
    return {
      floor_m: this.floor(),
      heading: this.walk.heading + this.body,
      // WebXR looks along -z, a body along +z: half a turn about y lies between their frames
      rotation: [-this.turn.x, this.turn.y, -this.turn.z, this.turn.w],
      head_m: [0, this.head.y - this.rest, 0],
      left_hand: this.hand("left"),
      right_hand: this.hand("right"),
    };
  }

  /** A hand in the body's frame, whose origin is the floor below the head. */
  private hand(side: "left" | "right"): Message["left_hand"] {
    const wrist = this.hands[side];
    // a headset that has been laid down shows no pictures, and tells of no hands
    if (!wrist || this.session!.visibilityState === "hidden") return null;
    const [at, turn] = [new Vector3(), new Quaternion()];
    wrist.decompose(at, turn, new Vector3());
    at.sub(this.head).setY(at.y + this.head.y).applyAxisAngle(UP, -this.body);
    turn.premultiply(this.turn.setFromAxisAngle(UP, -this.body));
    return [-at.x, at.y, -at.z, -turn.x, turn.y, -turn.z, turn.w];
  }

  private async enter(): Promise<void> {
    if (this.entering) return;
    this.entering = true;
    let session: XRSession | undefined;
    try {
      session = await navigator.xr!.requestSession("immersive-vr", { optionalFeatures: ["local-floor", "hand-tracking"] });
      this.renderer.xr.setReferenceSpaceType("local-floor");
      await this.renderer.xr.setSession(session);
      session.addEventListener("end", () => this.end());
      [this.session, this.rest, this.body] = [session, undefined, 0];
      this.button.textContent = "Take the headset off";
      this.begun();
      this.carry();
      if (this.over) void session.end(); // while the browser asked
    } catch (error) {
      void session?.end().catch(() => undefined); // or the headset waits for pictures that never come
      this.tell(`The headset cannot be used (${error instanceof Error ? error.message : error}).`);
    } finally {
      this.entering = false;
    }
  }

  /** The page goes on where the headset was. */
  private end(): void {
    [this.walk.x, this.walk.z] = this.floor();
    this.walk.heading += this.yaw();
    this.session = undefined;
    this.button.textContent = "Put the headset on";
    this.rig.position.set(0, 0, 0);
    this.rig.rotation.y = 0;
  }

  private carry(): void {
    this.rig.position.set(this.walk.x, 0, this.walk.z);
    this.rig.rotation.y = this.walk.heading + Math.PI;
  }

  /** How far the head is turned from the rig's front, to the left. */
  private yaw(): number {
    this.ahead.set(0, 0, -1).applyQuaternion(this.headTurn);
    return Math.atan2(-this.ahead.x, -this.ahead.z);
  }

  /** Where the head is above the floor. */
  private floor(): [number, number] {
    const { x, z } = this.head;
    const [sin, cos] = [Math.sin(this.walk.heading), Math.cos(this.walk.heading)];
    return [this.walk.x - cos * x - sin * z, this.walk.z + sin * x - cos * z];
  }

  /** Turn about the head, which stays where it is. */
  private snap(x: number): void {
    if (Math.abs(x) < RELEASED) this.turned = false;
    if (Math.abs(x) < PUSHED || this.turned) return;
    this.turned = true;
    const before = this.floor();
    this.walk.heading -= Math.sign(x) * SNAP;
    const after = this.floor();
    this.walk.x += before[0] - after[0];
    this.walk.z += before[1] - after[1];
  }

  /** Walk where one looks; the head goes no further than a body may. */
  private stride(x: number, y: number, seconds: number): void {
    if (Math.hypot(x, y) < DEAD) return;
    const heading = this.walk.heading + this.yaw();
    const [sin, cos] = [Math.sin(heading), Math.cos(heading)];
    const step = PACE * seconds;
    const [headX, headZ] = this.floor();
    const [toX, toZ] = this.walk.layout.allowed(headX + (-y * sin - x * cos) * step, headZ + (-y * cos + x * sin) * step);
    this.walk.x += toX - headX;
    this.walk.z += toZ - headZ;
  }
}
