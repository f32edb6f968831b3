/** The avatar on its stage, and the ways to bring another one. */

import { AvatarError, fetchAvatar, openAvatar, Portrait, type Avatar, type Face } from "../avatar/index.js";
import { byId } from "../elements.js";

/** Springs of hair and clothes come to rest in about that time, behind the last change. */
const SETTLE_MS = 1500;

export class Stage {
  avatar: Avatar | undefined;
  private readonly portrait: Portrait | undefined;
  private stale = true;
  private drawnAt = 0;
  private changedAt = 0;
  private newest = 0;

  constructor(private readonly say: (sentence: string) => void) {
    const canvas = byId<HTMLCanvasElement>("portrait");
    try {
      this.portrait = new Portrait(canvas);
    } catch {
      say("This browser gives no WebGL, so the avatar cannot be drawn; bars and pictures go on.");
    }
    new ResizeObserver(() => this.changed()).observe(canvas);
    this.takeDrops();
    const file = byId<HTMLInputElement>("file");
    file.addEventListener("change", () => {
      const chosen = file.files?.[0];
      if (chosen) void this.wear(chosen);
      file.value = "";
    });
    byId("ours").addEventListener("click", () => void this.wearOurs());
  }

  async wearOurs(): Promise<void> {
    const found = await this.tryOn("The avatar of track", (name) => fetchAvatar(`avatar${location.search}`, name));
    if (found) byId("ours").hidden = true;
  }

  async wear(file: File): Promise<void> {
    const found = await this.tryOn(file.name, () => openAvatar(file));
    if (found) byId("ours").hidden = false;
  }

  /** Draw where anything has changed. */
  draw(face: Face | undefined): void {
    const now = performance.now();
    if (face && this.avatar) {
      this.avatar.drive(face);
      this.changed();
    }
    const springs = this.avatar?.vrm && now - this.changedAt < SETTLE_MS;
    if (!this.portrait || !(this.stale || springs)) return;
    this.portrait.draw(Math.min((now - this.drawnAt) / 1000, 0.1));
    this.drawnAt = now;
    this.stale = false;
  }

  private changed(): void {
    this.stale = true;
    this.changedAt = performance.now();
  }

  /** Put an avatar on, or say why not and keep the last one; of two at once the later one counts. */
  private async tryOn(name: string, load: (name: string) => Promise<Avatar>): Promise<boolean> {
    if (!this.portrait) return false;
    const turn = ++this.newest;
    let avatar: Avatar;
    try {
      avatar = await load(name);
    } catch (error) {
      if (!(error instanceof AvatarError)) console.warn(`${name}:`, error);
      this.say(error instanceof AvatarError ? error.message : `${name} cannot be shown: it seems damaged. Export it again.`);
      return false;
    }
    if (turn !== this.newest) {
      avatar.dispose();
      return false;
    }
    this.avatar = avatar;
    this.portrait.show(avatar);
    this.changed();
    this.say(avatar.lacks());
    return true;
  }

  private takeDrops(): void {
    const sign = byId("drop");
    addEventListener("dragover", (event) => {
      event.preventDefault();
      sign.hidden = !event.dataTransfer?.types.includes("Files");
    });
    addEventListener("dragleave", (event) => {
      if (event.relatedTarget === null) sign.hidden = true;
    });
    addEventListener("drop", (event) => {
      event.preventDefault();
      sign.hidden = true;
      const file = event.dataTransfer?.files[0];
      if (file) void this.wear(file);
    });
  }
}
