// Draws one avatar as it is told, for `acting.py`: `act` gives a picture of a face.

import { Color } from "three";

import { fetchAvatar, Portrait, type Face } from "../../web/avatar/index.js";

const canvas = document.querySelector("canvas")!;
const portrait = new Portrait(canvas);
portrait.scene.background = new Color(0x9aa7ad);

const ready = fetchAvatar("/head.glb", "head").then((avatar) => {
  portrait.show(avatar);
  return avatar;
});

Object.assign(window, {
  act: async (face: Face): Promise<string> => {
    (await ready).drive(face);
    portrait.draw(1 / 30);
    return canvas.toDataURL("image/jpeg", 0.93);
  },
});
