/** The avatar before a camera as webcams are, which `acting.py` tells what to do, picture by picture. */

import { Color } from "three";

import { fetchAvatar, Portrait } from "../../web/avatar/index.js";

/** From top to bottom, of a camera that sees 60 degrees across a 4:3 picture. */
const FIELD_DEG = 46.8;

const canvas = document.querySelector("canvas")!;
const portrait = new Portrait(canvas);
portrait.scene.background = new Color(0x9aa7ad);
const avatar = await fetchAvatar("/head.glb", "head.glb");
portrait.show(avatar);
portrait.draw(0);
const { camera } = portrait;
const nearer = Math.tan((camera.fov * Math.PI) / 360) / Math.tan((FIELD_DEG * Math.PI) / 360);
camera.position.z *= 1.15 * nearer;
camera.fov = FIELD_DEG;
camera.updateProjectionMatrix();

/** Draw a face, and give the picture as PNG in base 64. */
function act(weights: number[], gaze: [number, number, number, number], head: [number, number, number]): string {
  avatar.drive({ weights: Float32Array.from(weights), gaze, head });
  portrait.draw(1 / 30);
  return canvas.toDataURL("image/png").split(",")[1]!;
}

Object.assign(window, { act });
