/** Draws the room as one person sees it, and that person in a small mirror. */

import { DirectionalLight, Group, PCFShadowMap, PerspectiveCamera, Quaternion, Scene, SRGBColorSpace, Vector3, WebGLRenderer, NeutralToneMapping, type Object3D } from "three";

import { EYES_M } from "../figure/body.js";
import { BACKGROUND, type Place } from "./place.js";

const FIELD_DEG = 50;
const MOST_PIXEL_RATIO = 2;
/** The own body is on this layer, which the own eyes do not see; 1 and 2 are those of a headset's two eyes. */
const SELF = 3;
/** Of the light that goes where one looks: lamps of a ceiling leave faces in the shade of their brows, dark ones above all. */
const FILL = 0.8;
/** The mirror hangs so far before the face, in metres. */
const MIRROR_M = 0.62;

export class View {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(FIELD_DEG, 1, 0.05, 40);
  readonly eye = new Vector3();
  /** Carries the camera of a headset. */
  readonly rig = new Group();
  /** Of one's own face above the floor while one stands: avatars are of all sizes, and eyes of one. */
  face_m = EYES_M;
  private readonly mirror = new PerspectiveCamera(32, 150 / 170, 0.05, 20);
  readonly renderer: WebGLRenderer;
  private readonly small: CanvasRenderingContext2D;

  /** Throws where the browser gives no WebGL. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly glass: HTMLCanvasElement,
    place: Place,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: false });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.xr.enabled = true;
    this.scene.add(this.rig.add(this.camera));
    const fill = new DirectionalLight(0xffffff, FILL);
    fill.position.set(0, 0, 0);
    fill.target.position.set(0, 0, -1);
    this.camera.add(fill, fill.target);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene.background = BACKGROUND;
    place.reflect(this.renderer);
    place.root.traverse((node) => node.layers.enable(SELF));
    this.scene.add(place.root);
    this.mirror.layers.set(SELF); // nobody else stands between a face and its mirror
    [glass.width, glass.height] = [300, 340];
    this.small = glass.getContext("2d")!;
  }

  /** Make an object one's own: only the mirror shows it. */
  hide(own: Object3D): void {
    own.traverse((node) => node.layers.set(SELF));
  }

  /** Look from where one stands, turned by heading and pitch. */
  look(x: number, z: number, height: number, heading: number, pitch: number): void {
    this.eye.set(x, height, z);
    if (this.renderer.xr.isPresenting) {
      this.camera.getWorldPosition(this.eye);
      return;
    }
    this.camera.position.copy(this.eye);
    // a camera looks along -z, a body along +z
    this.camera.quaternion.copy(turned(heading + Math.PI, pitch));
    const ahead = new Vector3(Math.sin(heading), 0, Math.cos(heading));
    const face = height + this.face_m - EYES_M;
    this.mirror.position.set(x, face - 0.05, z).addScaledVector(ahead, MIRROR_M);
    this.mirror.lookAt(x, face - 0.06, z);
  }

  /** Call this whenever a picture is due, of the page or of a headset. */
  start(due: () => void): void {
    this.renderer.setAnimationLoop(due);
  }

  /** Throws where something cannot be drawn; the next picture may be drawn nevertheless. */
  draw(): void {
    const target = this.renderer.getRenderTarget(); // of a headset
    try {
      this.paint();
    } catch (error) {
      this.renderer.setRenderTarget(target); // it was a shadow's, perhaps
      this.frame(this.canvas.width, this.canvas.height, false);
      throw error;
    }
  }

  private paint(): void {
    if (this.renderer.xr.isPresenting) {
      this.renderer.render(this.scene, this.camera);
      return;
    }
    const ratio = Math.min(devicePixelRatio, MOST_PIXEL_RATIO);
    const { clientWidth, clientHeight } = this.canvas; // what is seen of a window, of which a telephone's bars take a part
    const [width, height] = [clientWidth, clientHeight].map((side) => Math.max(1, Math.round(side * ratio))) as [number, number];
    if (!this.glass.hidden) this.reflect();
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
    }
    this.renderer.render(this.scene, this.camera);
  }

  /** The own picture, the other way round as in a mirror; drawn into a corner first, then copied. */
  private reflect(): void {
    const { width, height } = this.glass;
    const share = Math.min(1, this.canvas.width / width, this.canvas.height / height); // of a window smaller than the glass
    const [across, up] = [Math.floor(width * share), Math.floor(height * share)];
    this.frame(across, up, true);
    this.renderer.render(this.scene, this.mirror);
    this.small.setTransform(-1, 0, 0, 1, width, 0);
    this.small.drawImage(this.canvas, 0, this.canvas.height - up, across, up, 0, 0, width, height);
    this.frame(this.canvas.width, this.canvas.height, false);
  }

  /** Draw into the lower left corner of this size; `alone` leaves what is around it as it is. */
  private frame(width: number, height: number, alone: boolean): void {
    this.renderer.setViewport(0, 0, width, height);
    this.renderer.setScissor(0, 0, width, height);
    this.renderer.setScissorTest(alone);
  }
}

const about = { yaw: new Quaternion(), pitch: new Quaternion() };
const UP = new Vector3(0, 1, 0);
const SIDE = new Vector3(1, 0, 0);

function turned(yaw: number, pitch: number): Quaternion {
  about.yaw.setFromAxisAngle(UP, yaw);
  about.pitch.setFromAxisAngle(SIDE, pitch);
  return about.yaw.multiply(about.pitch);
}
