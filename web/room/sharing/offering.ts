/** The list and buttons by which somebody shares: a window, a picture, or a PDF page by page. */

import { byId } from "../../elements.js";
import { isOfSystem } from "../door/join.js";
import { isMeant } from "../keys/keys.js";
import { openByKeys } from "../keys/lists.js";
import type { Paper } from "./paper.js";
import type { Sharing } from "./sharing.js";

/** The reader of PDFs is 1.5 MB: it comes when somebody chooses one. */
const READER = "/static/paper.js";

interface Meeting {
  /** Whether a moderator has muted this person. */
  muted(): boolean;
  /** Who else shares now. */
  sharer(): string | undefined;
  say(on: boolean): void;
  tell(text: string): void;
}

export class Offering {
  private paper: Paper | undefined;
  private page = 1;
  /** What others see; behind `page` while that is drawn. */
  private shown = 1;
  private turning = false;

  constructor(
    private readonly sharing: Sharing,
    private readonly meeting: Meeting,
    screens: boolean,
  ) {
    const share = byId<HTMLSelectElement>("share");
    // telephones have no windows to give
    if (!("getDisplayMedia" in (navigator.mediaDevices ?? {}))) share.querySelector("[value=window]")!.remove();
    share.hidden = !screens;
    openByKeys(share);
    const [picture, paper] = [byId<HTMLInputElement>("file"), byId<HTMLInputElement>("paper")];
    share.addEventListener("change", () => {
      const wish = share.value;
      share.value = "";
      share.blur();
      if (wish === "window") void this.begin(() => this.sharing.window());
      if (wish === "picture") picture.click();
      if (wish === "paper") paper.click();
      if (wish === "nothing") this.end();
    });
    this.chosen(picture, (file) => this.begin(() => this.sharing.picture(file)));
    this.chosen(paper, (file) => this.begin(() => this.open(file), true));
    byId("before").addEventListener("click", () => void this.turn(this.page - 1));
    byId("next").addEventListener("click", () => void this.turn(this.page + 1));
    addEventListener("keydown", (event) => {
      if (!this.paper || !isMeant(event)) return;
      if (event.key === "PageUp") void this.turn(this.page - 1);
      if (event.key === "PageDown") void this.turn(this.page + 1);
    });
  }

  /** Show nothing more. */
  end(): void {
    if (this.sharing.shares) {
      this.sharing.end();
      this.meeting.say(false);
    }
    this.follow();
  }

  /** Put the PDF away once it is shared no longer, whoever ended it. */
  follow(): void {
    if (!this.sharing.shares) this.put(undefined);
  }

  private chosen(input: HTMLInputElement, take: (file: File) => Promise<void>): void {
    input.addEventListener("change", () => {
      const [file] = input.files ?? [];
      if (file) void take(file);
      input.value = "";
    });
  }

  private async begin(take: () => Promise<void>, pages = false): Promise<void> {
    if (this.meeting.muted()) return this.meeting.tell("A moderator has muted you; nothing is shared.");
    const other = this.meeting.sharer();
    if (other) return this.meeting.tell(`${other} shares already; they or a moderator can end it.`);
    try {
      await take();
      if (!pages) this.put(undefined);
      if (!this.sharing.shares) return this.follow(); // the meeting has ended meanwhile
      this.meeting.say(true);
    } catch (error) {
      const refused = error instanceof DOMException && error.name === "NotAllowedError";
      const why = error instanceof Error ? error.message.replace(/\.$/, "") : error;
      const system = "Nothing is shared: the system keeps the screen from the browser; allow it in the system's privacy settings.";
      this.meeting.tell(isOfSystem(error) ? system : refused ? "" : `Nothing is shared: ${why}.`);
    }
  }

  private async open(file: Blob): Promise<void> {
    const { Paper } = (await import(READER)) as typeof import("./paper.js");
    const paper = await Paper.open(file);
    try {
      this.sharing.still(await paper.draw(1));
    } catch (error) {
      paper.close();
      throw error;
    }
    this.put(paper);
  }

  private async turn(page: number): Promise<void> {
    const { paper } = this;
    if (!paper || page < 1 || page > paper.pages) return;
    this.page = page;
    this.count();
    if (this.turning) return; // who turns quickly sees the last one, not each on the way
    this.turning = true;
    try {
      while (this.shown !== this.page) {
        const drawn = this.page;
        const picture = await paper.draw(drawn);
        if (this.paper !== paper) return;
        this.sharing.still(picture);
        this.shown = drawn;
      }
    } catch (error) {
      if (this.paper !== paper) return;
      this.page = this.shown;
      this.count();
      this.meeting.tell(`The page before stays: ${error instanceof Error ? error.message : error}.`);
    } finally {
      this.turning = false;
    }
  }

  private put(paper: Paper | undefined): void {
    if (paper === this.paper) return;
    this.paper?.close();
    this.paper = paper;
    this.page = this.shown = 1;
    byId("pages").hidden = !paper;
    this.count();
  }

  private count(): void {
    if (!this.paper) return;
    byId("page").textContent = `${this.page} of ${this.paper.pages}`;
    byId<HTMLButtonElement>("before").disabled = this.page === 1;
    byId<HTMLButtonElement>("next").disabled = this.page === this.paper.pages;
  }
}
