/** The shared screen: what is to be seen on the boards of a place, and who may put it there. */

import type { Mesh } from "three";

import type { Candidate, Description, Person, Said } from "../line/texts.js";
import type { People } from "../people/people.js";
import { Board } from "./board.js";
import { Offering } from "./offering.js";
import { Sharing } from "./sharing.js";

export class Screen {
  readonly board: Board;
  readonly sharing: Sharing;
  private readonly offering: Offering;

  /** `meshes` are those of the place that may show something. */
  constructor(
    meshes: readonly Mesh[],
    private readonly people: () => People,
    private readonly say: (said: Said) => boolean,
    tell: (text: string) => void,
  ) {
    this.board = new Board(meshes);
    this.sharing = new Sharing(
      say,
      (stream) => this.board.show(stream),
      () => this.offering.end(),
    );
    const meeting = {
      muted: () => people().self?.muted ?? false,
      sharer: () => people().others.find(({ person }) => person.shares)?.person.name,
      say: (on: boolean) => void say({ kind: "share", on }),
      tell,
    };
    this.offering = new Offering(this.sharing, meeting, meshes.length > 0);
  }

  /** Come in, or come back, once it is known who is here. */
  configure(ice: RTCIceServer[]): void {
    this.sharing.configure(ice);
    // a server that started anew forgot it, and one that did not may not have heard that it ended
    const { shares } = this.sharing;
    if (shares || this.people().self?.shares) this.say({ kind: "share", on: shares });
  }

  meet(people: readonly Person[], own: string): void {
    this.sharing.meet(people, own);
    this.offering.follow();
  }

  hear(from: Person, signal: Description | Candidate): void {
    void this.sharing.hear(from, signal);
  }

  /** Nobody sees what was taken already: the room did not let this page share. */
  refuse(): void {
    this.offering.end();
  }

  /** Show nothing more for good. */
  close(): void {
    this.sharing.close();
    this.offering.follow();
  }
}
