/** One person as others see them: avatar and body where they stand, a name, and a sign while they speak. */

import { CanvasTexture, Euler, Group, Mesh, MeshBasicMaterial, Quaternion, RingGeometry, Sprite, SpriteMaterial, SRGBColorSpace, Vector3, type SkinnedMesh } from "three";

import { release, type Avatar } from "../../avatar/index.js";
import { FLAG, type Message } from "../line/protocol.js";
import type { Person } from "../line/texts.js";
import { EYES_M, makeBody, SEATED_M } from "./body.js";
import { headGesture, Limbs } from "./limbs.js";
import type { Hand } from "./reach.js";

/** Above the eyes: clear of hair. */
const NAME_M = 0.3;
/** Taller than this from its lowest to its highest point, an avatar has a body of its own. */
const WHOLE_M = 1.0;
/** Of a body without a head bone, where its eyes are; and of what is above the head's joint. */
const EYES_SHARE = 0.93;
const FACE_SHARE = 0.4;
/** Taller than a head with hair and neck, it has shoulders, and hangs in the air as busts do. */
const BUST_M = 0.36;

/** So far a head goes from a simple body's neck; then the body comes along. */
const NECK_M = 0.08;

/** Faster than a run is a jump to another place. */
const MOST_PACE = 4;

export class Figure {
  /** On the floor, where the person stands. */
  readonly root = new Group();
  private readonly upper = new Group();
  private readonly limbs: Limbs;
  private lowered = 0;
  private readonly before = new Vector3();
  private readonly label = new Sprite(new SpriteMaterial({ transparent: true, depthWrite: false }));
  private readonly sign: Mesh<RingGeometry, MeshBasicMaterial>;
  /** The simple body under a head, of nobody else. */
  private readonly made: Group | undefined;
  private readonly turn = new Quaternion();
  private readonly angles = new Euler();
  private time = 0;
  private speaking = false;
  /** Height of what hangs on `upper` above the floor: a head and its simple body are made around the eyes. */
  private readonly standing: number;

  /** Of a face above the floor while it stands, in metres. */
  readonly face_m: number;

  constructor(
    readonly avatar: Avatar,
    number: number,
    height: number,
  ) {
    const whole = height > WHOLE_M;
    this.made = whole || height > BUST_M ? undefined : makeBody(number);
    const body = whole ? avatar.root : (this.made ?? new Group());
    this.limbs = new Limbs(body, whole ? avatar.vrm : undefined);
    this.standing = whole ? 0 : EYES_M;
    const joint = avatar.headJoint_m;
    this.face_m = !whole ? EYES_M : joint === undefined ? EYES_SHARE * height : joint + FACE_SHARE * (height - joint);
    this.upper.add(avatar.root, body);
    avatar.root.traverse((node) => void (node.castShadow = true));
    const top = whole ? height + NAME_M / 2 : NAME_M;
    this.label.position.y = top;
    this.sign = new Mesh(new RingGeometry(0.022, 0.034, 32), new MeshBasicMaterial({ color: 0x2fbf6b, transparent: true }));
    this.sign.position.y = top + 0.09;
    this.sign.visible = false;
    this.upper.add(this.label, this.sign);
    this.root.add(this.upper);
  }

  /** The name, and what others should know: away, muted, moved by a program or without a camera. */
  call(person: Person, tracked: boolean): void {
    const word = !person.present ? "away" : person.muted ? "muted" : person.face === "program" ? "face by a program" : tracked ? "" : "no camera";
    const text = `${person.name}|${word}`;
    if (this.label.userData["text"] === text) return;
    this.label.userData["text"] = text;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [512, 128];
    const pen = canvas.getContext("2d")!;
    pen.textAlign = "center";
    pen.font = "30px system-ui, sans-serif";
    const wordWidth = pen.measureText(word).width;
    pen.font = "600 44px system-ui, sans-serif";
    const width = Math.min(500, Math.max(pen.measureText(person.name).width, wordWidth, 120) + 56);
    pen.fillStyle = "rgba(22, 26, 30, 0.72)";
    pen.beginPath();
    pen.roundRect((512 - width) / 2, word ? 8 : 30, width, word ? 112 : 72, 24);
    pen.fill();
    pen.fillStyle = "#fff";
    pen.fillText(person.name, 256, word ? 60 : 82, 460);
    pen.font = "30px system-ui, sans-serif";
    pen.fillStyle = "#c9d2d8";
    if (word) pen.fillText(word, 256, 102, 460);
    const { material } = this.label;
    material.map?.dispose();
    material.map = new CanvasTexture(canvas);
    material.map.colorSpace = SRGBColorSpace;
    material.needsUpdate = true;
  }

  /** The sign follows the newest message, not the delayed ones: a voice is heard at once. */
  speak(speaking: boolean): void {
    this.speaking = speaking;
    this.sign.visible = speaking;
  }

  get signShown(): boolean {
    return this.speaking;
  }

  /** Names are for others: one's own picture in the corner has none. */
  nameless(): void {
    this.label.removeFromParent();
    this.sign.removeFromParent();
  }

  /** Show a state; `eye` is where it is seen from. */
  show(message: Message, seconds: number, eye: Vector3): void {
    this.time += seconds;
    this.root.position.set(message.floor_m[0]!, 0, message.floor_m[1]!);
    this.root.rotation.y = message.heading;
    const seated = (message.flags & FLAG.seated) !== 0;
    this.lowered += ((seated ? EYES_M - SEATED_M : 0) - this.lowered) * (1 - Math.exp(-8 * seconds));
    this.upper.position.y = this.standing - this.lowered;
    if (this.standing) this.lean(message.head_m);
    this.turn.set(message.rotation[0]!, message.rotation[1]!, message.rotation[2]!, message.rotation[3]!).normalize();
    this.angles.setFromQuaternion(this.turn, "YXZ");
    const gesture = headGesture(message.animation, this.time);
    this.avatar.drive({
      weights: message.weights,
      gaze: [message.gaze[0]!, message.gaze[1]!, message.gaze[2]!, message.gaze[3]!],
      head: [this.angles.y + gesture.yaw, -this.angles.x + gesture.pitch, -this.angles.z],
    });
    this.avatar.update(seconds);
    const hands = [this.reached(message.left_hand), this.reached(message.right_hand)];
    this.limbs.update(message.animation, seated, this.pace(message, seconds), seconds, hands);
    // names are read across the room as well: from two metres on they keep their size in the picture
    const far = Math.max(1, eye.distanceTo(this.root.position) / 2);
    this.label.scale.set(0.4 * far, 0.1 * far, 1);
    this.sign.position.y = this.label.position.y + 0.085 * far;
    if (this.speaking) {
      this.sign.lookAt(eye);
      this.sign.scale.setScalar(far * (1.1 + 0.15 * Math.sin(8 * this.time)));
    }
  }

  /** Put where the right hand is into `at`; of a body without hands, before its chest. */
  hand(at: Vector3): void {
    const { rightHand } = this.limbs;
    if (rightHand) rightHand.getWorldPosition(at);
    else this.root.localToWorld(at.set(-0.15, EYES_M - 0.35 - this.lowered, 0.25));
  }

  /** Put the head where it is, and what is below it so near that a neck reaches. */
  private lean(head_m: ArrayLike<number>): void {
    const head = this.avatar.root.position.fromArray(Array.from(head_m));
    this.made?.position.copy(head).clampLength(0, NECK_M).negate().add(head);
  }

  /** A hand of a message in the frame of the body that hangs on `upper`. */
  private reached(hand: Message["left_hand"]): Hand | undefined {
    if (!hand) return undefined;
    const [x, y, z, ...turn] = Array.from(hand) as [number, number, number, number, number, number, number];
    const at = new Vector3(x, y - this.upper.position.y, z);
    if (this.made) at.sub(this.made.position);
    return { at, turn: new Quaternion(...turn).normalize() };
  }

  /** How fast the body walks forward, in metres a second. */
  private pace(message: Message, seconds: number): number {
    const { position } = this.root;
    const forward = (position.x - this.before.x) * Math.sin(message.heading) + (position.z - this.before.z) * Math.cos(message.heading);
    this.before.copy(position);
    const pace = seconds > 0 ? forward / seconds : 0;
    return Math.abs(pace) < MOST_PACE ? pace : 0;
  }

  dispose(): void {
    this.label.material.map?.dispose();
    this.label.material.dispose();
    this.sign.geometry.dispose();
    this.sign.material.dispose();
    if (this.made) release(this.made);
    // meshes and pictures belong to all who wear this avatar, but each has bones of their own
    this.avatar.root.traverse((node) => (node as Partial<SkinnedMesh>).skeleton?.dispose());
    this.root.removeFromParent();
  }
}
