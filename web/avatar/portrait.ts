/** A picture of one avatar: light, frame and drawing. */

import {
  Box3,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  NeutralToneMapping,
  PerspectiveCamera,
  Scene,
  SRGBColorSpace,
  Vector3,
  WebGLRenderer,
} from "three";

import type { Avatar } from "./avatar.js";
import { findBone } from "./bones.js";

/** A portrait lens: 85 mm on 35 mm film sees 16 degrees in height; a little more leaves room for hair. */
const FIELD_DEG = 20;
/** In heights of what the face's shapes move, brows to chin: below it to the shoulders, above it to the crown at most. */
const [BELOW, ABOVE, MARGIN] = [0.4, 1.2, 0.12];
/** Where a bust ends it has an edge; the picture ends above it. */
const EDGE = 0.12;
/** Of an avatar's height, what is above the bone of its head at least: a person's is an eighth. */
const LEAST_HEAD = 0.05;
/** Nobody's eyes gain from more, and telephones claim up to 4. */
const MOST_PIXEL_RATIO = 2;

/** Key from the upper left, a cool fill from the right, a rim from behind: shapes show without hard shadows. */
export function portraitLights(): Group {
  const lights = new Group();
  lights.add(new HemisphereLight(0xffffff, 0xb3a79c, 1.7));
  for (const [colour, strength, x, y, z] of [
    [0xfff1e0, 2.1, -1.2, 1.4, 2.2],
    [0xdfe9ff, 0.7, 2.0, 0.3, 1.4],
    [0xffffff, 1.3, 0.6, 1.8, -2.2],
  ] as const) {
    const light = new DirectionalLight(colour, strength);
    light.position.set(x, y, z);
    lights.add(light);
  }
  return lights;
}

/** Where to look, in the world, and how high the picture is there. */
export function frameOf(avatar: Avatar): { centre: Vector3; height: number } {
  avatar.root.updateMatrixWorld(true);
  const face = avatar.morphs.faceBox();
  const whole = new Box3().setFromObject(avatar.root);
  if (face.isEmpty()) return frameOfHead(avatar, whole) ?? frameOfBox(whole);
  const { y } = face.getSize(new Vector3());
  const bottom = Math.max(face.min.y - BELOW * y, whole.min.y + EDGE * y);
  const top = Math.min(face.max.y + ABOVE * y, whole.max.y) + MARGIN * y;
  return { centre: face.getCenter(new Vector3()).setY((top + bottom) / 2), height: top - bottom };
}

/** From under the chin to above the crown, by the bone of a head whose shapes have names of their own. */
function frameOfHead(avatar: Avatar, whole: Box3): { centre: Vector3; height: number } | undefined {
  const centre = findBone(avatar.model, "head", avatar.vrm)?.getWorldPosition(new Vector3());
  const size = whole.max.y - (centre?.y ?? Infinity);
  if (!centre || size < LEAST_HEAD * whole.getSize(new Vector3()).y) return undefined;
  const [bottom, top] = [centre.y - BELOW * size, whole.max.y + MARGIN * size];
  return { centre: centre.setY((top + bottom) / 2), height: top - bottom };
}

/** The upper quarter of a body, or the whole of what is no body. */
function frameOfBox(whole: Box3): { centre: Vector3; height: number } {
  const size = whole.getSize(new Vector3());
  const centre = whole.getCenter(new Vector3());
  if (size.y < 2 * size.x) return { centre, height: size.y * 1.15 };
  const height = size.y / 4;
  return { centre: centre.setY(whole.max.y + height * 0.1 - height / 2), height };
}

export class Portrait {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(FIELD_DEG, 1, 0.01, 50);
  private readonly renderer: WebGLRenderer;
  private avatar: Avatar | undefined;
  private frame = { centre: new Vector3(), height: 0.4 };

  /** Throws where the browser gives no WebGL. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.setClearColor(new Color(0), 0);
    this.scene.add(portraitLights());
  }

  /** Show an avatar in place of the last one, which is freed. */
  show(avatar: Avatar): void {
    this.avatar?.dispose();
    this.avatar = avatar;
    this.scene.add(avatar.root);
    this.frame = frameOf(avatar);
    this.aim();
  }

  /** Draw, behind so many seconds since the last time. */
  draw(seconds: number): void {
    this.resize();
    this.avatar?.update(seconds);
    this.renderer.render(this.scene, this.camera);
  }

  private resize(): void {
    const ratio = Math.min(devicePixelRatio, MOST_PIXEL_RATIO);
    const { clientWidth, clientHeight } = this.canvas;
    const [width, height] = [Math.round(clientWidth * ratio), Math.round(clientHeight * ratio)];
    if (!width || !height || (this.canvas.width === width && this.canvas.height === height)) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.aim();
  }

  private aim(): void {
    const { centre, height } = this.frame;
    // a picture higher than wide still shows both ears
    const needed = height * Math.max(1, 0.8 / this.camera.aspect);
    const distance = needed / 2 / Math.tan((FIELD_DEG * Math.PI) / 360);
    this.camera.position.set(centre.x, centre.y, centre.z + distance);
    this.camera.near = distance / 50;
    this.camera.far = distance * 20;
    this.camera.lookAt(centre);
    this.camera.updateProjectionMatrix();
  }
}
