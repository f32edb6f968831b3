/** The list of people and the chat. Whatever people typed becomes text, never markup. */

import { byId } from "../../elements.js";
import type { Act, Answer, Person } from "../line/texts.js";
import type { Voice } from "../voice/voice.js";
import type { Raised } from "./raised.js";
import { Row } from "./row.js";

/** Lines of chat that are kept on the page. */
const KEPT_LINES = 200;
/** Farther than this from the end somebody reads what was said before. */
const READS_PX = 40;

type Line = Extract<Answer, { kind: "line" }>;

export class Sidebar {
  private readonly people = byId<HTMLUListElement>("people");
  private readonly lines = byId<HTMLOListElement>("lines");
  private readonly input = byId<HTMLFormElement>("chat").elements.namedItem("text") as HTMLInputElement;
  private readonly rows = new Map<number, Row>();
  private said = "";

  constructor(
    private readonly voice: Voice,
    private readonly moderate: (action: Act, whom: Pick<Person, "number" | "id">) => void,
    say: (text: string) => boolean,
  ) {
    byId<HTMLFormElement>("chat").addEventListener("submit", (event) => {
      event.preventDefault();
      const text = this.input.value.trim();
      if (text && !say(text)) return; // it stays until it can be sent
      this.said = text;
      this.input.value = "";
    });
  }

  /** Give back the line that the room did not take, unless the next one is begun already. */
  unsaid(): void {
    this.input.value ||= this.said;
  }

  /** Show who is here; `own` is this person's number, `chair` whether they may moderate. */
  list(people: Iterable<Person>, own: number, chair: boolean, raised: Pick<Raised, "has">): void {
    const sorted = [...people].sort((a, b) => Number(b.number === own) - Number(a.number === own) || a.name.localeCompare(b.name));
    for (const [number, row] of this.rows) {
      if (sorted.some((person) => person.number === number && person.id === row.id)) continue;
      row.item.remove();
      this.rows.delete(number);
    }
    sorted.forEach((person, place) => {
      const { id, number } = person;
      const row = this.rows.get(number) ?? new Row(id, this.voice, (action) => this.moderate(action, { number, id }));
      this.rows.set(number, row);
      row.show(person, number === own, chair, raised.has(person));
      const there = this.people.children[place];
      if (there !== row.item) this.people.insertBefore(row.item, there ?? null);
    });
  }

  speak(number: number, speaking: boolean): void {
    this.rows.get(number)?.dot.classList.toggle("speaking", speaking);
  }

  /** A line of chat; a moderator's says so, as anybody may take any name. */
  line({ name, moderator, text, time_s }: Line): void {
    const item = document.createElement("li");
    item.title = new Date(time_s * 1000).toLocaleTimeString();
    const [who, said] = [document.createElement("b"), document.createElement("bdi")];
    const isolated = document.createElement("bdi");
    isolated.textContent = name;
    who.append(isolated, " ");
    said.textContent = text;
    const mark = document.createElement("small"); // no name is written so
    mark.textContent = moderator ? "moderator " : "";
    item.append(who, mark, said);
    const { scrollHeight, scrollTop, clientHeight } = this.lines;
    const reads = scrollHeight - scrollTop - clientHeight > READS_PX; // further up, where a new line must not take them away
    this.lines.append(item);
    while (this.lines.children.length > KEPT_LINES) this.lines.firstChild!.remove();
    if (!reads) item.scrollIntoView({ block: "end" });
  }
}
