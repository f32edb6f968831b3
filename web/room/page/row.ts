/** One person in the list: made once and changed in place, so that a hand on its slider, or a key on a button, stays there. */

import { clothesOf, written } from "../figure/colours.js";
import type { Act, Person } from "../line/texts.js";
import type { Voice } from "../voice/voice.js";

const ACTS: ReadonlyMap<Act, string> = new Map([
  ["mute", "mute"],
  ["unmute", "unmute"],
  ["undress", "take avatar off"],
  ["unshare", "stop sharing"],
  ["remove", "remove"],
]);

export class Row {
  readonly item = document.createElement("li");
  readonly dot = document.createElement("span");
  private readonly name = document.createElement("bdi"); // a name from right to left leaves the rest in its place
  private readonly slider = document.createElement("input");
  private readonly small = document.createElement("small");
  private readonly words = document.createTextNode("");
  private readonly buttons = new Map<Act, HTMLButtonElement>();

  constructor(
    readonly id: string,
    private readonly voice: Voice,
    moderate: (action: Act) => void,
  ) {
    this.dot.className = "dot";
    Object.assign(this.slider, { type: "range", min: "0", max: "2", step: "0.05", value: String(voice.volume(id)) });
    this.slider.addEventListener("input", () => voice.setVolume(id, this.slider.valueAsNumber));
    this.small.append(this.words);
    for (const [action, title] of ACTS) {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: title });
      button.addEventListener("click", () => {
        const what = `Remove ${this.name.textContent}? Their tab stays out; by the link they come in as somebody new, unless you lock the room.`;
        if (action !== "remove" || confirm(what)) moderate(action);
      });
      this.buttons.set(action, button);
      this.small.append(button);
    }
    this.item.append(this.dot, this.name, this.slider, this.small);
  }

  /** Show how a person is now; `self` is who looks at this page, `chair` whether they may moderate, `raises` whether a hand is up. */
  show(person: Person, self: boolean, chair: boolean, raises: boolean): void {
    this.dot.style.background = person.own ? "" : written(clothesOf(person.number)); // who brought an avatar wears its colours
    this.name.textContent = person.name + (self ? " (you)" : "");
    this.slider.hidden = self || person.replayed;
    this.slider.setAttribute("aria-label", `Volume of ${person.name}`);
    const words = [
      person.moderator ? "moderator" : "",
      person.present ? "" : "away",
      raises ? "raises a hand" : "",
      person.replayed ? "replay" : person.muted ? "muted by a moderator" : person.voice ? "" : "microphone off",
      this.voice.lacks(person.id) ? "voice does not arrive" : "",
      person.face === "program" ? "face by a program" : "",
      person.recorded ? "recorded" : "",
      person.shares ? "shares the screen" : "",
    ].filter(Boolean);
    const acts = chair && !self;
    this.words.data = words.join(" · ") + (acts && words.length ? " " : "");
    const can: Record<Act, boolean> = {
      mute: !person.muted,
      unmute: person.muted,
      undress: !!person.own,
      unshare: person.shares,
      remove: true,
      lock: false,
      unlock: false,
    };
    for (const [action, button] of this.buttons) {
      button.hidden = !acts || !can[action];
      button.setAttribute("aria-label", `${ACTS.get(action)}: ${person.name}`);
    }
    this.small.hidden = !words.length && !acts;
  }
}
