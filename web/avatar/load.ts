/** Reads a .glb or .vrm into an `Avatar`, or says in one sentence why it cannot. */

import { Box3, type Object3D } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { VRMLoaderPlugin, VRMUtils, type VRM } from "@pixiv/three-vrm";

import { Avatar } from "./avatar.js";

/** What is wrong with a file, as a sentence for whoever chose it. */
export class AvatarError extends Error {
  override name = "AvatarError";
}

/** As `facegen.formats.gltf_container.MOST_BYTES`. */
const MOST_BYTES = 512 * 2 ** 20;
const GLB = 0x46546c67; // "glTF", little endian

/** An avatar of a file that somebody chose. */
export async function openAvatar(file: File): Promise<Avatar> {
  checkSize(file.size, file.name); // more than 2 GB no browser reads
  const content = await file.arrayBuffer().catch(() => {
    throw new AvatarError(`${file.name} cannot be read, as it is a folder or is there no longer: choose a .glb or .vrm file.`);
  });
  return loadAvatar(content, file.name);
}

/** An avatar of a file's bytes; `name` is what it is called in sentences. */
export async function loadAvatar(content: ArrayBuffer, name: string): Promise<Avatar> {
  check(content, name);
  const loader = new GLTFLoader();
  loader.register((parser) => new VRMLoaderPlugin(parser));
  let gltf;
  try {
    gltf = await loader.parseAsync(content, "");
  } catch (error) {
    throw new AvatarError(sentence(name, error));
  }
  const vrm = gltf.userData["vrm"] as VRM | undefined;
  const model: Object3D = vrm?.scene ?? gltf.scene;
  if (!vrm && name.toLowerCase().endsWith(".vrm")) {
    throw new AvatarError(`${name} has no VRM part that can be read (VRM 0.x and 1.0 are): export it again as VRM.`);
  }
  if (vrm) VRMUtils.rotateVRM0(vrm);
  if (new Box3().setFromObject(model).isEmpty()) throw new AvatarError(`${name} holds nothing to look at: no mesh is in it.`);
  model.traverse((node) => {
    node.frustumCulled = false; // boxes are those of the face at rest
  });
  return new Avatar(name, model, vrm);
}

/** An avatar from an address of the page's own server. */
export async function fetchAvatar(address: string, name: string): Promise<Avatar> {
  const answer = await fetch(address).catch(() => undefined);
  if (!answer?.ok) throw new AvatarError(`${name} could not be fetched.`);
  return loadAvatar(await answer.arrayBuffer(), name);
}

function checkSize(bytes: number, name: string): void {
  if (bytes > MOST_BYTES) throw new AvatarError(`${name} is larger than 512 MiB, the most that is read.`);
}

function check(content: ArrayBuffer, name: string): void {
  checkSize(content.byteLength, name);
  const header = new DataView(content);
  if (content.byteLength < 20 || header.getUint32(0, true) !== GLB) {
    throw new AvatarError(`${name} is no .glb or .vrm file: its first bytes are not those of binary glTF.`);
  }
  if (header.getUint32(4, true) !== 2) throw new AvatarError(`${name} is glTF ${header.getUint32(4, true)}; version 2 is read.`);
  const claimed = header.getUint32(8, true);
  if (claimed > content.byteLength) {
    throw new AvatarError(`${name} is cut off: it says ${claimed} bytes and has ${content.byteLength}.`);
  }
}

/** The loader's complaint, for people. */
function sentence(name: string, error: unknown): string {
  const said = error instanceof Error ? error.message : String(error);
  if (/DRACO/i.test(said)) return `${name} is compressed with Draco, which is not read here: export it without compression.`;
  if (/meshopt/i.test(said)) return `${name} is compressed with meshopt, which is not read here: export it without compression.`;
  if (/KTX2/i.test(said)) return `${name} has KTX2 pictures, which are not read here: export it with PNG or JPEG.`;
  return `${name} cannot be read, because it is damaged or no whole avatar (${said.replace(/^THREE\.GLTFLoader: /, "").slice(0, 120)}).`;
}
