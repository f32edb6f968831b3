/**
 * Gives each person colours of their own, so that two in one avatar are told apart.
 *
 * All pages come to the same colours, as they follow from what all know: the number, which the room gives so that its first
 * twelve people differ (`room/state/numbers.py`), and the id. Own avatars keep theirs.
 */

import { Mesh, type Material, type MeshStandardMaterial, type Object3D } from "three";

import type { Person } from "../line/texts.js";

/** Of clothes: told apart at the far side of a table, and none is the green of who speaks. Their count is `room.state.numbers.COLOURS`. */
export const CLOTHES = [
  0x2f6f73, 0x8a2f48, 0x223463, 0xc2a86a, 0x6a4a96, 0x9cc0d4, 0xa9562c, 0x5f7038, 0xc98aa0, 0x3b78c2, 0x4c4a4a, 0xd4d2c6,
] as const;

/** Of hair, as people have it; from black to brown for who has dark hair in their avatar. */
const HAIR = [0x17120f, 0x3a2419, 0x5a3322, 0x6e6c6a, 0x7a4a26, 0xa8834e] as const;
const DARK_HAIR = 4;
/** Red, green and blue together below which hair is dark, of 3. */
const DARK = 0.06;

/** Materials of the server's avatars (`facegen rig export --body`). */
const WORN = new Set(["top", "trousers", "skirt", "cap"]);

export interface Colours {
  readonly clothes: number;
  /** Picks one of the colours of hair. */
  readonly hair: number;
}

type Who = Pick<Person, "number" | "id">;

export function clothesOf(number: number): number {
  return CLOTHES[number % CLOTHES.length]!;
}

export function coloursOf({ number, id }: Who): Colours {
  // people of a recording have the recorded id within theirs, and so the hair they had
  const hex = /[0-9a-f]{16}/.exec(id)?.[0] ?? "0";
  return { clothes: clothesOf(number), hair: Number.parseInt(hex.slice(0, 8), 16) };
}

/** As pages write colours. */
export function written(colour: number): string {
  return `#${colour.toString(16).padStart(6, "0")}`;
}

/** Colour the clothes and hair of one of the server's avatars for one person; gives what frees it again. */
export function dye(model: Object3D, { clothes, hair }: Colours): () => void {
  const dyed = new Map<Material, MeshStandardMaterial>();
  const dyedOf = (material: Material): Material => {
    const worn = WORN.has(material.name);
    if (!worn && material.name !== "hair") return material;
    const known = dyed.get(material);
    if (known) return known;
    const own = (material as MeshStandardMaterial).clone();
    const { r, g, b } = own.color;
    own.color.setHex(worn ? clothes : HAIR[hair % (r + g + b < DARK ? DARK_HAIR : HAIR.length)]!);
    dyed.set(material, own);
    return own;
  };
  model.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    const { material } = node as Mesh<Mesh["geometry"], Material | Material[]>;
    node.material = Array.isArray(material) ? material.map(dyedOf) : dyedOf(material);
  });
  return () => {
    for (const own of dyed.values()) own.dispose();
  };
}
