/** What is seen: the room, the people in it and where they point, drawn as often as the browser asks for a picture. */

import { FLAG } from "./line/protocol.js";
import type { Known, People } from "./people/people.js";
import type { Presence } from "./presence/presence.js";
import type { Place } from "./scene/place.js";
import { Pointers } from "./scene/pointers.js";
import { View } from "./scene/view.js";

export class Stage {
  readonly view: View;
  readonly pointers: Pointers;
  /** Whether pictures are drawn; tests without a graphics card leave the processor to the rest. */
  drawing = true;
  private drawn = performance.now();

  /** Throws where the browser gives no WebGL. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly glass: HTMLCanvasElement,
    place: Place,
  ) {
    this.view = new View(canvas, glass, place);
    this.pointers = new Pointers(this.view.scene, place);
  }

  /** Show the room and one's mirror; `draw` is called for each picture. */
  begin(draw: () => void): void {
    this.canvas.hidden = this.glass.hidden = false;
    this.view.start(draw);
  }

  /** The room is empty now, and nobody looks into the mirror. */
  end(): void {
    this.glass.hidden = true;
  }

  /** One picture, as one sees the others from where one stands. */
  draw(people: People, presence: Presence): void {
    const now = performance.now();
    const seconds = Math.min(0.1, (now - this.drawn) / 1000);
    this.drawn = now;
    presence.look(this.view, seconds);
    for (const known of people.known.values()) {
      try {
        this.show(known, known.person.number === people.own, presence, now, seconds);
      } catch (error) {
        console.warn(`the avatar of ${known.person.name}:`, error);
        people.refuse(known);
      }
    }
    if (this.drawing) this.paint(people);
  }

  private show({ person, playback, figure }: Known, self: boolean, presence: Presence, now: number, seconds: number): void {
    const shown = playback.at(now);
    if (!figure || !shown) return;
    figure.root.visible = true;
    // one's own picture shows what is sent, as a mirror that lags is worse than none; but a program's face only comes back
    const mine = self && person.face === "page" ? presence.sent : undefined;
    if (self) this.view.face_m = figure.face_m;
    figure.show(mine ?? shown, seconds, this.view.eye);
    this.pointers.show(person.number, mine ?? shown, figure, this.view.eye, self);
    if (!self) figure.call(person, (shown.flags & FLAG.tracked) !== 0);
  }

  /**
   * Draw; where an avatar breaks the picture off, one after the other is left out until one comes. The last of them is taken off
   * if it breaks the picture off once more.
   */
  private paint(people: People): void {
    const seen = [...people.known.values()].filter(({ figure }) => figure?.root.visible);
    for (const known of [undefined, ...seen]) {
      if (known) known.figure!.root.visible = false;
      if (!this.draws()) continue;
      if (known) {
        known.figure!.root.visible = true;
        if (!this.draws()) people.refuse(known); // else what broke off once was nobody's
      }
      break;
    }
    for (const { figure } of seen) if (figure) figure.root.visible = true;
  }

  private draws(): boolean {
    try {
      this.view.draw();
      return true;
    } catch (error) {
      console.warn("picture:", error);
      return false;
    }
  }
}
