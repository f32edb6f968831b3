/**
 * Shares a window, a picture or a page with all: straight from browser to browser, a connection for each who looks.
 *
 * Who shares calls, and the others answer; the room's server says who may. Voices go their own way.
 */

import type { Candidate, Description, Person } from "../line/texts.js";
import { begins, candidateOf, PATIENCE_MS, saidOf, sessionOf, type Send } from "../voice/lines.js";
import { Still, type Picture } from "./still.js";

/** Of a shared window: text stays sharp, and a film stutters a little. */
const WINDOW_HERTZ = 12;

interface Viewer {
  readonly connection: RTCPeerConnection;
  readonly visit: string;
  number: number;
}

export class Sharing {
  private own: MediaStream | undefined;
  private shown: Still | undefined;
  /** Whether the room knows that this page shares. */
  private granted = false;
  private closed = false;
  private readonly viewers = new Map<string, Viewer>();
  private sharer: { id: string; visit: string; connection?: RTCPeerConnection } | undefined;
  private ice: RTCIceServer[] = [];

  constructor(
    private readonly send: Send,
    /** Called with what is to be seen on the screens now. */
    private readonly show: (stream: MediaStream | undefined) => void,
    /** Called when the browser's own button ends a window's sharing. */
    private readonly ended: () => void,
  ) {}

  /** Come in, or come back: the room may have forgotten meanwhile that this page shares. */
  configure(ice: RTCIceServer[]): void {
    this.ice = ice;
    this.granted = false;
  }

  get shares(): boolean {
    return this.own !== undefined;
  }

  /** Ask for a window; throws what the browser says, or where it has none to give. */
  async window(): Promise<void> {
    this.take(await navigator.mediaDevices.getDisplayMedia({ video: { frameRate: WINDOW_HERTZ }, audio: false }));
  }

  /** Show a picture of a file; throws where the browser cannot read it. */
  async picture(file: Blob): Promise<void> {
    this.still(await createImageBitmap(file));
  }

  /** Show a picture, in place of the one that is shown. */
  still(picture: Picture): void {
    if (this.shown && this.own === this.shown.stream) return this.shown.turn(picture);
    const still = new Still(picture);
    this.take(still.stream);
    this.shown = still;
  }

  /** Show nothing more. */
  end(): void {
    for (const track of this.own?.getTracks() ?? []) track.stop();
    this.own = this.shown = undefined;
    this.granted = false;
    for (const id of [...this.viewers.keys()]) this.hangUp(id);
    this.show(undefined);
  }

  /** Show nothing more for good, also of what a browser still asks its person for. */
  close(): void {
    this.closed = true;
    this.end();
    this.drop();
  }

  /** Call everybody who is here, or let go of who shares no longer; `own` is this person's id. */
  meet(people: readonly Person[], own: string): void {
    const sharer = people.find(({ shares }) => shares);
    if (this.own && sharer?.id !== own && (this.granted || sharer)) this.end(); // a moderator's word, or somebody was faster
    const granted = this.own !== undefined && sharer?.id === own;
    // who looked may have hung up while the room had forgotten it: all are called anew
    if (granted && !this.granted) for (const id of [...this.viewers.keys()]) this.hangUp(id);
    this.granted = granted;
    if (this.sharer && (sharer?.id !== this.sharer.id || sharer.visit !== this.sharer.visit)) this.drop();
    if (sharer && sharer.id !== own) this.sharer ??= { id: sharer.id, visit: sharer.visit };
    for (const [id, { visit }] of [...this.viewers]) {
      const person = people.find((each) => each.id === id);
      if (!person?.present || person.visit !== visit) this.hangUp(id);
    }
    if (!this.own || sharer?.id !== own) return;
    for (const person of people) {
      const viewer = this.viewers.get(person.id);
      if (viewer) viewer.number = person.number;
      else if (person.id !== own && person.present && !person.replayed) this.call(person);
    }
  }

  async hear(from: Person, signal: Description | Candidate): Promise<void> {
    try {
      const connection = signal.kind === "description" && signal.type === "offer" ? this.answerer(from, signal.sdp) : this.of(from.id);
      if (!connection) return;
      if (signal.kind === "candidate") {
        await connection.addIceCandidate(candidateOf(signal));
        return;
      }
      await connection.setRemoteDescription(signal);
      if (signal.type !== "offer") return;
      await connection.setLocalDescription();
      this.describe(connection, from.number);
    } catch (error) {
      console.warn("screen:", error); // a word of a connection that has ended meanwhile
    }
  }

  private take(stream: MediaStream): void {
    if (this.closed) return stream.getTracks().forEach((each) => each.stop());
    const [track] = stream.getVideoTracks();
    track!.contentHint = "detail";
    track!.addEventListener("ended", () => this.own === stream && this.ended());
    for (const before of this.own?.getTracks() ?? []) before.stop();
    this.shown = undefined;
    for (const { connection } of this.viewers.values()) void connection.getSenders()[0]?.replaceTrack(track!);
    this.own = stream;
    this.show(stream);
  }

  private of(id: string): RTCPeerConnection | undefined {
    return this.viewers.get(id)?.connection ?? (this.sharer?.id === id ? this.sharer.connection : undefined);
  }

  private call({ id, number, visit }: Pick<Person, "id" | "number" | "visit">): void {
    const connection = this.connect(() => viewer.number);
    const viewer: Viewer = { connection, visit, number };
    this.viewers.set(id, viewer);
    setTimeout(() => this.callAgain(id, viewer), PATIENCE_MS);
    connection.onnegotiationneeded = async () => {
      await connection.setLocalDescription();
      this.describe(connection, viewer.number);
    };
    connection.addTransceiver(this.own!.getVideoTracks()[0]!, { direction: "sendonly", streams: [this.own!] });
  }

  /** Give up a call that was not answered. */
  private callAgain(id: string, viewer: Viewer): void {
    if (this.viewers.get(id) !== viewer || !begins(viewer.connection)) return;
    this.hangUp(id);
    this.call({ id, ...viewer });
  }

  /** The connection by which the one who shares is seen; nobody else may show anything. */
  private answerer({ id, number }: Person, offer: string): RTCPeerConnection | undefined {
    if (this.sharer?.id !== id) return undefined;
    const before = this.sharer.connection;
    const same = sessionOf(offer) === sessionOf(before?.remoteDescription?.sdp);
    if (same && before?.signalingState === "stable" && before.connectionState === "connected") return before;
    before?.close();
    const connection = this.connect(() => number);
    connection.ontrack = ({ track }) => this.show(new MediaStream([track]));
    this.sharer.connection = connection;
    return connection;
  }

  private connect(number: () => number): RTCPeerConnection {
    const connection = new RTCPeerConnection({ iceServers: this.ice });
    connection.onicecandidate = ({ candidate }) => {
      if (candidate) this.send({ ...saidOf(candidate, number()), plane: "screen" });
    };
    connection.oniceconnectionstatechange = () => {
      if (connection.iceConnectionState === "failed") connection.restartIce();
    };
    return connection;
  }

  private describe({ localDescription }: RTCPeerConnection, to: number): void {
    const { type, sdp } = localDescription!;
    if (type !== "pranswer") this.send({ kind: "description", plane: "screen", to, type, sdp });
  }

  private hangUp(id: string): void {
    const viewer = this.viewers.get(id);
    this.viewers.delete(id);
    if (viewer) viewer.connection.onnegotiationneeded = viewer.connection.onicecandidate = null;
    viewer?.connection.close();
  }

  /** Somebody's screen is over. */
  private drop(): void {
    this.sharer?.connection?.close();
    this.sharer = undefined;
    if (!this.own) this.show(undefined);
  }
}
