/** Everybody in the room as this page knows them: who they are, how they look, and where they were last. */

import type { Scene, Object3D } from "three";

import { coloursOf, dye } from "../figure/colours.js";
import { Figure } from "../figure/figure.js";
import type { Message } from "../line/protocol.js";
import type { Person } from "../line/texts.js";
import { PLAIN, Wardrobe, type Dressed } from "./avatars.js";
import type { Brought } from "./brought.js";
import { Playback } from "./playback.js";
import { again } from "./tries.js";

/** Somebody else, or oneself. */
export interface Known {
  person: Person;
  readonly playback: Playback;
  figure: Figure | undefined;
  wears: string;
  /** Whether the figure is in an avatar that they brought, and not in one of the room's. */
  own: boolean;
  /** Frees what an avatar of their own holds. */
  free: () => void;
  newest: Message | undefined;
}

export class People {
  readonly known = new Map<number, Known>();
  /** The number of who looks at this page; nobody before the welcome. */
  own = -1;
  private readonly wardrobe = new Wardrobe();

  constructor(
    private readonly view: { readonly scene: Scene; hide(own: Object3D): void },
    private readonly brought: Brought,
  ) {}

  /** Come in, or come back: who is there still, in the same clothes, keeps them, as they take time to load. */
  welcome(people: readonly Person[], own: number): void {
    this.own = own;
    const there = new Map(people.map(({ number, id }) => [number, id]));
    for (const { person } of [...this.known.values()]) if (there.get(person.number) !== person.id) this.part(person.number);
    for (const person of people) this.meet(person);
  }

  /** Forget everybody. */
  clear(): void {
    for (const known of this.known.values()) undress(known);
    this.known.clear();
  }

  /** Somebody came, or is another than they were. */
  meet(person: Person): void {
    const known = this.known.get(person.number) ?? {
      person,
      playback: new Playback(),
      figure: undefined,
      wears: "",
      own: false,
      free: () => undefined,
      newest: undefined,
    };
    if (known.person.face !== person.face) known.playback.restart(); // their clocks differ
    known.person = person;
    this.known.set(person.number, known);
    if (person.number === this.own) this.brought.wears(person.own);
    const wears = `${person.avatar} ${person.own}`;
    if (known.wears === wears) return;
    known.wears = wears;
    void this.clothe(known, person, wears);
  }

  /** Take off what cannot be drawn, for as long as they wear it: the room's avatar stands in, and for that one the plain head. */
  refuse(known: Known): void {
    const { person, own, figure } = known;
    if (figure?.avatar.name === PLAIN) return;
    void this.clothe(known, { ...person, own: "", avatar: own ? person.avatar : PLAIN }, known.wears);
  }

  /** Somebody left; says who it was. */
  part(number: number): Person | undefined {
    const known = this.known.get(number);
    if (known) undress(known);
    this.known.delete(number);
    return known?.person;
  }

  /** Who looks at this page; nobody before the welcome, and after the meeting. */
  get self(): Person | undefined {
    return this.known.get(this.own)?.person;
  }

  get all(): Person[] {
    return [...this.known.values()].map(({ person }) => person);
  }

  /** All but oneself. */
  get others(): Known[] {
    return [...this.known.values()].filter(({ person }) => person.number !== this.own);
  }

  /** Where the others stand. */
  taken(): [number, number][] {
    return this.others.flatMap(({ newest }): [number, number][] => (newest ? [[newest.floor_m[0]!, newest.floor_m[1]!]] : []));
  }

  /** The plain head until the room's avatar is there, and that one until the person's own is. */
  private async clothe(known: Known, person: Person, wears: string): Promise<void> {
    const still = (): boolean => this.known.get(person.number) === known && known.wears === wears;
    let over = false; // whether what they brought is on: it may be there before the room's
    const bare = (): boolean => still() && !over;
    const own = person.own ? this.brought.fetch(person.own, still) : undefined;
    if (!known.figure || !person.own) {
      const plain = this.wardrobe.plain();
      this.dress(known, plain, () => plain.avatar.dispose());
    }
    if (person.avatar !== PLAIN) {
      void again(() => this.wardrobe.another(person.avatar), bare).then((ready) => {
        if (ready && bare()) this.dress(known, ready, dye(ready.avatar.root, coloursOf(person)));
      });
    }
    const brought = await own;
    if (!brought) return;
    if (!still()) return brought.avatar.dispose();
    try {
      this.dress(known, brought, () => brought.avatar.dispose(), true);
      over = true;
    } catch (error) {
      console.warn("an avatar that somebody brought:", error); // what they wore before stays on
      brought.avatar.dispose();
    }
  }

  private dress(known: Known, { avatar, height }: Dressed, free = (): void => undefined, own = false): void {
    const figure = new Figure(avatar, known.person.number, height);
    undress(known);
    Object.assign(known, { figure, free, own });
    figure.root.visible = false; // until it is known where they stand
    this.view.scene.add(figure.root);
    if (known.person.number === this.own) {
      figure.nameless();
      this.view.hide(figure.root);
    }
  }
}

function undress(known: Known): void {
  known.figure?.dispose();
  known.free();
  known.figure = undefined;
}
