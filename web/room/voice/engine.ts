/**
 * Voices by an engine in the middle: one connection up with the own voice, one down with all the others', each by itself.
 *
 * The room speaks with the engine (room/server/person_voice.py); this page knows its two lines alone.
 */

import type { Candidate, Description, Person } from "../line/texts.js";
import { saidOf, type Lines, type Send } from "./lines.js";

export class Engine implements Lines {
  /** Whose voice each sound of the next description down is: ids by `mid`. */
  voices: Record<string, string> = {};
  private up: RTCPeerConnection | undefined;
  private down: RTCPeerConnection | undefined;
  private track: MediaStreamTrack | null = null;
  private ready = false;
  private playing = new Set<string>();
  private ice: RTCIceServer[] = [];

  constructor(
    private readonly send: Send,
    private readonly out: { play(id: string, track: MediaStreamTrack): void; stop(id: string): void },
  ) {}

  configure(ice: RTCIceServer[]): void {
    this.ice = ice;
  }

  /** The engine takes lines from now on, new ones; or it is away. */
  begin(ready: boolean): void {
    this.close();
    this.ready = ready;
    if (ready && this.track) void this.call(this.track);
  }

  speakInto(track: MediaStreamTrack | null): void {
    this.track = track;
    if (this.up) void this.up.getTransceivers()[0]?.sender.replaceTrack(track);
    else if (track && this.ready) void this.call(track);
  }

  meet(_people: ReadonlyMap<string, Person>): void {} // the engine knows who speaks

  part(id: string): void {
    this.playing.delete(id);
  }

  async hear(line: string, signal: Description | Candidate): Promise<void> {
    if (signal.kind === "candidate") return; // the engine's addresses stand in its descriptions
    try {
      if (line === "up") await this.up?.setRemoteDescription(signal);
      else if (line === "down") await this.take(signal);
    } catch (error) {
      console.warn("voice:", error); // of a line that has ended meanwhile
    }
  }

  state(id: string): RTCPeerConnectionState {
    return this.playing.has(id) ? (this.down?.connectionState ?? "new") : "new";
  }

  close(): void {
    this.ready = false;
    for (const line of [this.up, this.down]) line?.close();
    this.up = this.down = undefined;
    for (const id of this.playing) this.out.stop(id);
    this.playing.clear();
  }

  private async call(track: MediaStreamTrack): Promise<void> {
    const up = (this.up = this.line("up"));
    up.addTransceiver(track, { direction: "sendonly" });
    await up.setLocalDescription();
    if (up === this.up) this.describe("up", up);
  }

  /** Answer what the engine offers, and hear what it now brings. */
  private async take(offer: Description): Promise<void> {
    const [voices, down] = [this.voices, (this.down ??= this.line("down"))];
    await down.setRemoteDescription(offer);
    await down.setLocalDescription();
    if (down !== this.down) return;
    this.describe("down", down);
    const before = this.playing;
    this.playing = new Set(Object.values(voices));
    for (const id of before) if (!this.playing.has(id)) this.out.stop(id);
    for (const { mid, receiver } of down.getTransceivers()) {
      const id = mid === null ? undefined : voices[mid];
      if (id) this.out.play(id, receiver.track);
    }
  }

  private line(name: "up" | "down"): RTCPeerConnection {
    const connection = new RTCPeerConnection({ iceServers: this.ice });
    connection.onicecandidate = ({ candidate }) => {
      if (candidate && connection === this[name]) this.send(saidOf(candidate, name));
    };
    return connection;
  }

  private describe(to: "up" | "down", { localDescription }: RTCPeerConnection): void {
    const { type, sdp } = localDescription!;
    if (type === "offer" || type === "answer") this.send({ kind: "description", to, type, sdp });
  }
}
