/** What an avatar held of the graphics card is free once it is gone, whatever its materials are. */

import assert from "node:assert/strict";
import { test } from "node:test";

import { MToonMaterial } from "@pixiv/three-vrm";
import { BoxGeometry, Group, Mesh, MeshStandardMaterial, Texture } from "three";

import { release } from "../../avatar/avatar.js";

test("pictures of usual materials and of MToon's are freed", () => {
  const freed: string[] = [];
  const picture = (name: string): Texture => {
    const texture = new Texture();
    texture.addEventListener("dispose", () => freed.push(name));
    return texture;
  };
  const toon = new MToonMaterial();
  toon.map = picture("map");
  toon.shadeMultiplyTexture = picture("shade");
  const usual = new MeshStandardMaterial({ map: picture("usual") });
  release(new Group().add(new Mesh(new BoxGeometry(), [toon, usual])));
  assert.deepEqual(freed.sort(), ["map", "shade", "usual"]);
});
