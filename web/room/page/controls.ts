/** The row of buttons under the picture: what each does is the meeting's, what it says is here. */

import { byId } from "../../elements.js";
import { isMeant } from "../keys/keys.js";
import { openByKeys } from "../keys/lists.js";
import { ANIMATIONS } from "../line/protocol.js";
import type { Person, Said, Welcome } from "../line/texts.js";
import type { Microphone } from "../voice/microphone.js";

/** What buttons and keys ask for. */
export interface Wishes {
  say(said: Said): void;
  /** Take the face of now for the neutral one. */
  neutral(): void;
  sit(): void;
  /** Of a key that is pressed again the gesture ends. */
  gesture(number: number, again: boolean): void;
  lock(): void;
  consent(): void;
  leave(): void;
}

export class Controls {
  private readonly mute = byId<HTMLButtonElement>("mute");
  private readonly seatButton = byId<HTMLButtonElement>("seat");
  private readonly select = byId<HTMLSelectElement>("gesture");

  /** `faceLink` is what a program needs to move one's face. */
  constructor(
    private readonly microphone: Microphone | undefined,
    faceLink: string,
    wishes: Wishes,
  ) {
    this.showMute();
    const sayMute = (): void => {
      wishes.say({ kind: "voice", open: this.microphone!.isOpen });
      this.showMute();
    };
    if (microphone) microphone.onGone = sayMute;
    this.mute.addEventListener("click", () => {
      this.microphone!.isOpen = !this.microphone!.isOpen;
      sayMute();
    });
    byId("neutral").addEventListener("click", () => wishes.neutral());
    this.seatButton.addEventListener("click", () => wishes.sit());
    this.select.replaceChildren(
      ...ANIMATIONS.map((name, number) => new Option(number ? `${number} ${name}` : "Gesture …", String(number))),
    );
    openByKeys(this.select);
    this.select.addEventListener("change", () => {
      wishes.gesture(Number(this.select.value), false);
      this.select.blur();
    });
    addEventListener("keydown", (event) => {
      const number = /^\d$/.test(event.key) ? Number(event.key) : Infinity;
      if (number < ANIMATIONS.length && !event.repeat && isMeant(event)) wishes.gesture(number, true);
    });
    byId("program").addEventListener("click", () => {
      const command = `track --to "room:${faceLink}"`; // cmd.exe knows no other quotes
      const copied = navigator.clipboard?.writeText(command).then(() => "Copied. ", () => "") ?? Promise.resolve("");
      void copied.then((word) =>
        prompt(`${word}Run this on the machine with the camera or headset; whoever has this link moves your face:`, command),
      );
    });
    byId("lock").addEventListener("click", () => wishes.lock());
    byId("consent").addEventListener("click", () => wishes.consent());
    byId("leave").addEventListener("click", () => wishes.leave());
  }

  gesture(number: number): void {
    this.select.value = String(number);
  }

  seat(seated: boolean): void {
    const word = seated ? "Stand up" : "Sit";
    if (this.seatButton.textContent !== word) this.seatButton.textContent = word;
  }

  /** Show what the room allows, and what is known of who shares and who is recorded. */
  show(welcome: Welcome, people: readonly Person[], locked: boolean): void {
    const own = people.find(({ number }) => number === welcome.number);
    const sharer = people.find(({ shares }) => shares);
    const shared = byId("shared");
    shared.hidden = !sharer;
    shared.textContent = sharer ? (sharer.id === welcome.id ? "You share the screen" : `${sharer.name} shares the screen`) : "";
    const lock = byId<HTMLButtonElement>("lock");
    lock.hidden = !welcome.moderator;
    lock.textContent = locked ? "Unlock the room" : "Lock the room";
    const consent = byId<HTMLButtonElement>("consent");
    consent.hidden = !welcome.recording;
    consent.textContent = own?.recorded ? "Record me no longer" : "Agree to be recorded";
    const mark = byId("mark");
    mark.hidden = !welcome.replay && !own?.recorded;
    mark.textContent = welcome.replay ? "Replay" : "You are recorded";
  }

  private showMute(): void {
    const microphone = this.microphone?.gone ? undefined : this.microphone;
    this.mute.textContent = microphone ? (microphone.isOpen ? "Mute me" : "Unmute me") : "No microphone";
    this.mute.disabled = !microphone;
    this.mute.classList.toggle("on", microphone?.isOpen === false);
  }
}
