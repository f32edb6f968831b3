/** The list of people and the chat. Whatever people typed becomes text, never markup. */

import { clothesOf, written } from "./colours.js";
import type { Act, Person } from "./texts.js";
import type { Voice } from "./voice.js";

/** Lines of chat that are kept on the page. */
const KEPT_LINES = 200;

const find = <T extends HTMLElement>(id: string): T => document.querySelector<T>(`#${id}`)!;

export class Sidebar {
  private readonly people = find<HTMLUListElement>("people");
  private readonly lines = find<HTMLOListElement>("lines");
  private readonly dots = new Map<number, HTMLElement>();

  constructor(
    private readonly voice: Voice,
    private readonly moderate: (action: Act, number: number) => void,
    say: (text: string) => void,
  ) {
    find<HTMLFormElement>("chat").addEventListener("submit", (event) => {
      event.preventDefault();
      const input = (event.target as HTMLFormElement).elements.namedItem("text") as HTMLInputElement;
      if (input.value.trim()) say(input.value.trim());
      input.value = "";
    });
  }

  /** Show who is here; `own` is this person's number, `chair` whether they may moderate. */
  list(people: Iterable<Person>, own: number, chair: boolean): void {
    this.dots.clear();
    const sorted = [...people].sort((a, b) => Number(b.number === own) - Number(a.number === own) || a.name.localeCompare(b.name));
    this.people.replaceChildren(...sorted.map((person) => this.row(person, person.number === own, chair)));
  }

  speak(number: number, speaking: boolean): void {
    this.dots.get(number)?.classList.toggle("speaking", speaking);
  }

  line(name: string, text: string, time_s: number): void {
    const item = document.createElement("li");
    item.title = new Date(time_s * 1000).toLocaleTimeString();
    const who = document.createElement("b");
    who.textContent = `${name} `;
    item.append(who, text);
    this.lines.append(item);
    while (this.lines.children.length > KEPT_LINES) this.lines.firstChild!.remove();
    item.scrollIntoView({ block: "end" });
  }

  private row(person: Person, self: boolean, chair: boolean): HTMLLIElement {
    const item = document.createElement("li");
    const dot = document.createElement("span");
    dot.className = "dot";
    if (!person.own) dot.style.background = written(clothesOf(person.number)); // who brought an avatar wears its colours
    this.dots.set(person.number, dot);
    const name = document.createElement("span");
    name.textContent = person.name + (self ? " (you)" : "");
    item.append(dot, name);
    if (!self && !person.replayed) item.append(this.volume(person));
    const words = [
      person.moderator ? "moderator" : "",
      person.present ? "" : "away",
      person.replayed ? "replay" : person.muted ? "muted by a moderator" : person.voice ? "" : "microphone off",
      person.face === "program" ? "face by a program" : "",
      person.recorded ? "recorded" : "",
      person.shares ? "shares the screen" : "",
    ].filter(Boolean);
    const small = document.createElement("small");
    small.textContent = words.join(" · ");
    if (chair && !self) {
      small.append(words.length ? " " : "");
      const acts: Act[] = [
        person.muted ? "unmute" : "mute",
        ...(person.own ? (["undress"] as const) : []),
        ...(person.shares ? (["unshare"] as const) : []),
        "remove",
      ];
      for (const action of acts) {
        const button = document.createElement("button");
        button.type = "button";
        button.textContent = action === "undress" ? "take avatar off" : action === "unshare" ? "stop sharing" : action;
        button.addEventListener("click", () => this.moderate(action, person.number));
        small.append(button);
      }
    }
    if (small.childNodes.length && (words.length || chair)) item.append(small);
    return item;
  }

  private volume({ id, name }: Person): HTMLInputElement {
    const slider = document.createElement("input");
    Object.assign(slider, { type: "range", min: "0", max: "2", step: "0.05", value: String(this.voice.volume(id)) });
    slider.setAttribute("aria-label", `Volume of ${name}`);
    slider.addEventListener("input", () => this.voice.setVolume(id, slider.valueAsNumber));
    return slider;
  }
}
