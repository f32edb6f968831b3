/** The avatar that a person brings, and those of the others: sent and fetched with the room's key, checked before it is worn. */

import { AvatarError, loadAvatar } from "../../avatar/index.js";
import { byId } from "../../elements.js";
import { dressed, type Dressed } from "./avatars.js";
import { Files } from "./files.js";

/** Metres from the lowest to the highest point: a child of three, and somebody very tall in a hat. */
const LEAST_HEIGHT = 0.8;
const MOST_HEIGHT = 2.6;
/** As `room.avatars.check.MOST_AVATAR_BYTES`; the server counts again. */
const MOST_BYTES = 32 * 2 ** 20;

/** Whether a file's name is that of an avatar. */
export const isAvatar = ({ name }: File): boolean => /\.(glb|vrm)$/i.test(name);

/** Answers of a server to which as many come back at once after it began anew: too many of one person's, and of all. */
const BUSY = [429, 503];
/** The answer to who is not in the room, as behind a break of the line; and to whom a moderator forbade it. */
const FORBIDDEN = 403;

/** A sentence about an avatar stays so long. */
const TOLD_MS = 15_000;

export class Brought {
  private readonly button = byId<HTMLButtonElement>("bring");
  private readonly told = byId("told");
  private forgets = 0;
  private worn = "";
  private file: { name: string; content: ArrayBuffer } | undefined;
  /** Of the file, once the server has taken it. */
  private digest: string | undefined;
  private isIn = false;
  /** Whether the server forbade the file once: after coming in again it is brought once more. */
  private forbidden = false;
  private readonly files: Files;

  /** `address` is `/room/NAME/avatar`; `undress` says to the room that one of its own is worn again. */
  constructor(
    private readonly address: string,
    private readonly key: string,
    private readonly secret: string,
    undress: () => void,
  ) {
    this.files = new Files(address, key);
    const input = byId<HTMLInputElement>("brought");
    this.button.addEventListener("click", () => {
      if (!this.worn) return input.click();
      this.file = undefined;
      undress();
    });
    input.addEventListener("change", () => {
      const file = input.files?.[0];
      if (file) void this.wear(file);
      input.value = ""; // the same file again is a change again
    });
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => {
      event.preventDefault(); // or the browser opens the file, and the meeting is gone
      const files = [...(event.dataTransfer?.files ?? [])];
      const file = files.find(isAvatar);
      if (file) void this.wear(file);
      else if (files.length) this.tell("An avatar is a .glb or a .vrm; pictures and PDFs go by Share …");
    });
  }

  /** Wear a file, once it was read here and the server has taken it. */
  async wear(file: File): Promise<void> {
    try {
      if (file.size > MOST_BYTES) throw new AvatarError(`${file.name} is larger than 32 MiB, the most that is shown to others.`);
      const content = await file.arrayBuffer();
      const { avatar } = await read(content, file.name);
      const lacks = avatar.lacks();
      avatar.dispose();
      this.file = { name: file.name, content };
      this.digest = undefined;
      this.forbidden = false;
      if (this.isIn && (await this.send())) this.tell(lacks || `The others see you as ${file.name}.`);
    } catch (error) {
      if (!(error instanceof AvatarError)) console.warn(`${file.name}:`, error);
      this.tell(error instanceof AvatarError ? error.message : `${file.name} cannot be shown: it seems damaged. Export it again.`);
    }
  }

  /** Whether this page wants one's own avatar to be worn. */
  get wanted(): boolean {
    return this.file !== undefined;
  }

  /** Say nothing any more: the meeting is over. */
  end(): void {
    this.file = undefined;
    this.tell("");
  }

  /** After coming in: bring it again to a server that has forgotten it. */
  again(): void {
    this.isIn = true;
    if (this.file && this.worn !== this.digest) void this.send();
  }

  /** What one wears by the room's list; empty where it is one of the room's avatars. */
  wears(own: string): void {
    if (this.worn && !own) this.tell(""); // that the others see it is true no longer
    this.worn = own;
    this.button.textContent = own ? "Take my avatar off" : "My avatar …";
  }

  /** Somebody's avatar; undefined where they wear it no longer, by `wanted`, or it cannot be shown. */
  async fetch(digest: string, wanted: () => boolean): Promise<Dressed | undefined> {
    const content = await this.files.fetch(digest, wanted);
    try {
      return content && (await read(content, "avatar"));
    } catch (error) {
      console.warn("an avatar that somebody brought:", error);
      return undefined;
    }
  }

  private tell(text: string): void {
    this.told.textContent = text;
    clearTimeout(this.forgets);
    this.forgets = window.setTimeout(() => (this.told.textContent = ""), TOLD_MS);
  }

  private async send(): Promise<boolean> {
    const { name, content } = this.file!;
    const headers = { Authorization: `Bearer ${this.key}.${this.secret}` };
    const answer = await fetch(this.address, { method: "POST", body: content, headers }).catch(() => undefined);
    if (answer?.ok) {
      this.digest = ((await answer.json()) as { own: string }).own;
      this.forbidden = false;
      return true;
    }
    const why = answer ? (await answer.text()).trim().replace(/\.$/, "") : "the server could not be reached";
    if (!answer || BUSY.includes(answer.status)) {
      this.tell(`${name} is not shown to the others yet: ${why}; it is tried again.`);
      const { file } = this;
      this.digest = undefined;
      setTimeout(() => this.file === file && !this.digest && void this.send(), 1000 * (10 + 30 * Math.random()));
      return false;
    }
    if (answer.status !== FORBIDDEN || this.forbidden) this.file = undefined;
    this.forbidden = true;
    this.tell(`${name} is not shown to the others: ${why}.`);
    return false;
  }
}

/** An avatar that may stand among others: of a body's size, and without lamps of its own. */
async function read(content: ArrayBuffer, name: string): Promise<Dressed> {
  const avatar = await loadAvatar(content, name);
  avatar.model.traverse((node) => {
    if ("isLight" in node || "isCamera" in node) node.visible = false;
  });
  const found = dressed(avatar);
  if (found.height < LEAST_HEIGHT || found.height > MOST_HEIGHT) {
    avatar.dispose();
    throw new AvatarError(`${name} is ${found.height.toFixed(2)} m high; a whole body of ${LEAST_HEIGHT} to ${MOST_HEIGHT} m is needed: scale it.`);
  }
  return found;
}
