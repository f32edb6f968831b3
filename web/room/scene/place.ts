/** Loads the place in which people meet, a .glb of the room's server, and lights the people in it. */

import {
  AmbientLight,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  PlaneGeometry,
  PMREMGenerator,
  Quaternion,
  Scene,
  ShadowMaterial,
  Vector3,
  type Object3D,
  type WebGLRenderer,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import { Layout, type NamedNode } from "./layout.js";
import { Rays } from "./rays.js";

export const BACKGROUND = new Color(0xd3dad7);
/** Shadows of people lie so far above the floor, in metres: less would flicker. */
const ABOVE = 0.006;
/** Of the light that people take away. */
const SHADE = 0.4;
/** Steel mirrors the room as it is seen from here. */
const MIDDLE = new Vector3(0, 1.5, 0);

export class Place {
  readonly root = new Group();
  readonly layout: Layout;
  /** Meshes on which somebody's picture may be shown. */
  readonly screens: readonly Mesh[];
  private readonly rays: Rays;

  private constructor(
    model: Object3D,
    /** What was wrong with the file; empty where nothing was. */
    readonly word = "",
  ) {
    model.updateMatrixWorld(true);
    this.layout = new Layout(namedNodes(model));
    const meshes: Mesh[] = [];
    model.traverse((node) => void (node instanceof Mesh && meshes.push(node)));
    this.screens = meshes.filter((mesh) => nameOf(mesh).startsWith("screen") || nameOf(mesh.parent).startsWith("screen"));
    this.rays = new Rays(meshes);
    for (const mesh of meshes) mesh.receiveShadow = !(mesh.material instanceof MeshBasicMaterial);
    this.root.add(model, shade(), ...lights());
  }

  /** The place of a room; a plain floor where there is none that can be read. */
  static async load(room: string): Promise<Place> {
    try {
      const answer = await fetch(`/room/${room}/place.glb`);
      if (!answer.ok) throw new Error(`the server answers ${answer.status}`);
      const { scene } = await new GLTFLoader().parseAsync(await answer.arrayBuffer(), "");
      return new Place(scene);
    } catch (error) {
      console.warn("place:", error);
      return new Place(floor(), "The place could not be loaded; you meet on a plain floor.");
    }
  }

  /** Let steel mirror what is around it; without this it is black. */
  reflect(renderer: WebGLRenderer): void {
    const metals = new Set<MeshStandardMaterial>();
    this.root.traverse((node) => {
      if (node instanceof Mesh && node.material instanceof MeshStandardMaterial && node.material.metalness > 0.5) metals.add(node.material);
    });
    if (!metals.size) return;
    const scene = new Scene();
    scene.background = BACKGROUND;
    scene.add(this.root);
    const generator = new PMREMGenerator(renderer);
    const { texture } = generator.fromScene(scene, 0.02, 0.1, 40, { position: MIDDLE });
    generator.dispose();
    this.root.removeFromParent();
    for (const metal of metals) metal.envMap = texture;
  }

  /** Where a ray meets the place first. */
  hit(from: Vector3, direction: Vector3): Vector3 | undefined {
    return this.rays.hit(from, direction);
  }
}

function nameOf(node: Object3D | null): string {
  // the loader takes the dots out of names, and keeps them as they were here
  return String(node?.userData["name"] ?? node?.name ?? "");
}

function namedNodes(model: Object3D): NamedNode[] {
  const nodes: NamedNode[] = [];
  const [at, turn, scale] = [new Vector3(), new Quaternion(), new Vector3()];
  model.traverse((node) => {
    if (!nameOf(node)) return;
    node.matrixWorld.decompose(at, turn, scale);
    const ahead = new Vector3(0, 0, 1).applyQuaternion(turn);
    nodes.push({ name: nameOf(node), x: at.x, z: at.z, heading: Math.atan2(ahead.x, ahead.z), scale: [scale.x, scale.z] });
  });
  return nodes;
}

/** Darkens the floor where people stand between it and the lamp: baked light knows nothing of them. */
function shade(): Mesh {
  const mesh = new Mesh(new PlaneGeometry(40, 40), new ShadowMaterial({ opacity: SHADE }));
  mesh.rotation.x = -Math.PI / 2;
  mesh.position.y = ABOVE;
  mesh.receiveShadow = true;
  return mesh;
}

function floor(): Object3D {
  const mesh = new Mesh(new PlaneGeometry(40, 40), new MeshStandardMaterial({ color: 0x8d9a97, roughness: 0.9 }));
  mesh.rotation.x = -Math.PI / 2;
  return mesh;
}

/** For people, and for whatever a place has that is not baked. */
function lights(): Object3D[] {
  const sun = new DirectionalLight(0xfff4e6, 1.5);
  sun.position.set(1.4, 5, 1.8);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  Object.assign(sun.shadow.camera, { left: -5, right: 5, top: 5, bottom: -5, far: 12 });
  sun.shadow.bias = -0.002;
  sun.shadow.radius = 5;
  const back = new DirectionalLight(0xdfeaff, 0.9);
  back.position.set(0, 1.7, -4);
  return [new AmbientLight(0xffffff, 0.35), new HemisphereLight(0xfdf8f0, 0xa9b0a6, 2.1), sun, back];
}
