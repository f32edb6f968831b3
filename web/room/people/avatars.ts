/** Gives each person a figure: avatars are loaded once from this server, and shared by all who wear them. */

import { Box3, Vector3 } from "three";

import { Avatar, fetchAvatar } from "../../avatar/index.js";
import { plainHead } from "../figure/body.js";

/** The head that is made by code: it needs no file, and stands in while a file loads or where it cannot be read. */
export const PLAIN = "plain";

export interface Dressed {
  readonly avatar: Avatar;
  /** From its lowest to its highest point, in metres. */
  readonly height: number;
}

export class Wardrobe {
  private readonly loaded = new Map<string, Promise<Avatar | undefined>>();

  /** Names of the avatars that the server has, the plain one last. */
  static async names(): Promise<string[]> {
    const answer = await fetch("/avatars.json").catch(() => undefined); // the line itself says if nobody answers
    const names = answer?.ok ? ((await answer.json()) as string[]) : [];
    return [...names, PLAIN];
  }

  plain(): Dressed {
    return dressed(new Avatar(PLAIN, plainHead()));
  }

  /** One more of an avatar; undefined where the server has none of this name. */
  async another(name: string): Promise<Dressed | undefined> {
    if (name === PLAIN) return undefined;
    if (!this.loaded.has(name)) {
      const address = `/static/avatars/${name}.glb`;
      const loading = fetchAvatar(address, name).catch((error: unknown) => {
        console.warn(`avatar ${name}:`, error);
        this.loaded.delete(name); // the next who wears it may have more luck
        return undefined;
      });
      this.loaded.set(name, loading);
    }
    const avatar = await this.loaded.get(name);
    return avatar && dressed(avatar.another());
  }
}

export function dressed(avatar: Avatar): Dressed {
  avatar.root.updateMatrixWorld(true);
  return { avatar, height: new Box3().setFromObject(avatar.root).getSize(new Vector3()).y };
}
