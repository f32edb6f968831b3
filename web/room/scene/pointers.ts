/** Shows where people point: a thin ray from the hand, and a dot where it meets the room. */

import { BufferGeometry, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, Quaternion, SphereGeometry, Vector3, type Scene } from "three";

import { EYES_M, SEATED_M } from "../figure/body.js";
import type { Figure } from "../figure/figure.js";
import { FLAG, POINTER, type Message } from "../line/protocol.js";
import type { Place } from "./place.js";

/** Told apart from each other, and from teal and white rooms; by the number of a person. */
const COLOURS = [0xff3b30, 0xff9f0a, 0xbf5af2, 0x32d74b, 0x0a84ff, 0xffd60a];
/** Of the dot's radius: seen from five metres, and small from one. */
const DOT_M = 0.014;
const UP = new Vector3(0, 1, 0);

interface Beam {
  readonly dot: Mesh<SphereGeometry, MeshBasicMaterial>;
  readonly ray: Line<BufferGeometry, LineBasicMaterial>;
}

export class Pointers {
  private readonly beams = new Map<number, Beam>();
  private readonly from = new Vector3();
  private readonly along = new Vector3();
  private readonly turn = new Quaternion();

  constructor(
    private readonly scene: Scene,
    private readonly place: Place,
  ) {}

  /** Show what one person's state says; `eye` is where it is seen from, `own` says that it is one's own. */
  show(number: number, message: Message, figure: Figure, eye: Vector3, own: boolean): void {
    const at = message.animation === POINTER ? this.aim(message) : undefined;
    if (!at) return this.drop(number);
    const beam = this.beams.get(number) ?? this.make(number);
    beam.dot.position.copy(at);
    beam.dot.scale.setScalar(Math.max(1, eye.distanceTo(at) / 2.5));
    beam.ray.visible = !own; // from one's own eyes it would be a point
    figure.hand(this.from);
    beam.ray.geometry.setFromPoints([this.from, at]);
  }

  clear(): void {
    for (const number of [...this.beams.keys()]) this.drop(number);
  }

  drop(number: number): void {
    const beam = this.beams.get(number);
    if (!beam) return;
    this.beams.delete(number);
    for (const part of [beam.dot, beam.ray]) {
      part.removeFromParent();
      part.geometry.dispose();
      part.material.dispose();
    }
  }

  /** Where somebody looks, who points: heading and head together say it, from the eyes. */
  private aim({ floor_m, heading, rotation, flags }: Message): Vector3 | undefined {
    this.from.set(floor_m[0]!, flags & FLAG.seated ? SEATED_M : EYES_M, floor_m[1]!);
    this.turn.set(rotation[0]!, rotation[1]!, rotation[2]!, rotation[3]!).normalize();
    this.along.set(0, 0, 1).applyQuaternion(this.turn).applyAxisAngle(UP, heading);
    return this.place.hit(this.from, this.along);
  }

  private make(number: number): Beam {
    const color = COLOURS[number % COLOURS.length]!;
    const dot = new Mesh(new SphereGeometry(DOT_M, 20, 14), new MeshBasicMaterial({ color, toneMapped: false }));
    const ray = new Line(new BufferGeometry(), new LineBasicMaterial({ color, transparent: true, opacity: 0.55, toneMapped: false }));
    ray.frustumCulled = false;
    this.scene.add(dot, ray);
    const beam = { dot, ray };
    this.beams.set(number, beam);
    return beam;
  }
}
