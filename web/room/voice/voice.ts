/**
 * Voices of the others, heard from where they stand, whichever way they come: straight from browser to browser (mesh.ts), or
 * by an engine in the middle that passes each one on (engine.ts).
 */

import type { Answer, Candidate, Description, Person } from "../line/texts.js";
import { Arrivals } from "./arrivals.js";
import { Engine } from "./engine.js";
import type { Lines, Send } from "./lines.js";
import { Loopback } from "./loopback.js";
import { Mesh } from "./mesh.js";
import { glide, Sound, type Position } from "./sound.js";
import { Waker } from "./waker.js";

export class Voice {
  /** Made when the person joins: browsers play nothing before a click. */
  readonly context = new AudioContext();
  /** All voices together, as they are played. */
  readonly mix = new GainNode(this.context);
  readonly sounds = new Map<string, Sound>();
  readonly loopback: Loopback | undefined;
  lines: Lines | undefined;
  private readonly volumes = new Map<string, number>();
  private readonly muted = new Set<string>();
  private track: MediaStreamTrack | null = null;
  private readonly waker = new Waker(this.context);
  private readonly arrivals = new Arrivals();
  private others: Person[] = [];
  private ice: RTCIceServer[] = [];
  private engineWord = "";

  /** `echoes` where a microphone hears the loudspeakers: then the browser's echo cancellation has to see what is played. */
  constructor(
    private readonly send: Send,
    { echoes = false } = {},
  ) {
    if (echoes) this.loopback = new Loopback(this.context, this.mix);
    else this.mix.connect(this.context.destination);
  }

  /** What the person should know of voices; empty while all is well. */
  get word(): string {
    return this.engineWord || this.waker.word || this.arrivals.word(this.lines instanceof Engine, this.ice);
  }

  /** What the room says on coming in, again after each break; lines that are there go on. */
  configure(ice: RTCIceServer[], engine: boolean): void {
    this.ice = ice;
    if (engine && !(this.lines instanceof Engine)) this.use(new Engine(this.send, this));
    if (!engine && !(this.lines instanceof Mesh)) this.use(new Mesh(this.send, this));
    this.lines?.configure(ice);
  }

  /** Let the others hear this, or nothing; may change at any time. */
  speakInto(stream: MediaStream | undefined): void {
    this.track = stream?.getAudioTracks()[0] ?? null;
    this.lines?.speakInto(this.track);
  }

  meet(people: Iterable<Person>, own: string): void {
    const listed = new Map([...people].map((person) => [person.id, person]));
    this.lines?.meet(listed, own);
    this.others = [...listed.values()].filter(({ id }) => id !== own);
    for (const person of listed.values()) this.setMuted(person.id, person.muted);
  }

  part(id: string): void {
    this.lines?.part(id);
    this.stop(id);
  }

  /** `sender` is a person's id, or a line of an engine's. */
  async hear(sender: string, signal: Description | Candidate): Promise<void> {
    await this.lines?.hear(sender, signal);
  }

  /** What the room says of an engine. */
  engine(answer: Extract<Answer, { kind: "engine" | "heard" }>): void {
    if (!(this.lines instanceof Engine)) return;
    if (answer.kind === "heard") this.lines.voices = answer.voices;
    else {
      this.engineWord = answer.state === "away" ? "Voices are interrupted; they come back by themselves …" : "";
      this.lines.begin(answer.state === "ready");
    }
  }

  /** A voice has come in. */
  play(id: string, track: MediaStreamTrack): void {
    let sound = this.sounds.get(id);
    if (!sound) this.sounds.set(id, (sound = new Sound(this.context, this.mix, this.loudness(id))));
    sound.play(track);
  }

  /** A voice has ended. */
  stop(id: string): void {
    this.sounds.get(id)?.close();
    this.sounds.delete(id);
  }

  /** Put a voice where a head is. */
  place(id: string, at: Position): void {
    this.sounds.get(id)?.place(at);
  }

  /** Put the ears where the own head is, turned by its heading in radians (0 looks along z, to the left is positive). */
  listen(at: Position, heading: number): void {
    const { listener } = this.context;
    const [x, z] = [Math.sin(heading), Math.cos(heading)];
    if (!listener.positionX) {
      // Firefox has the old calls alone, which do not glide
      listener.setPosition(at.x, at.y, at.z);
      listener.setOrientation(x, 0, z, 0, 1, 0);
      return;
    }
    glide(this.context, [
      [listener.positionX, at.x],
      [listener.positionY, at.y],
      [listener.positionZ, at.z],
      [listener.forwardX, x],
      [listener.forwardZ, z],
    ]);
  }

  /** How loud somebody is here; 1 is as they are. */
  setVolume(id: string, volume: number): void {
    this.volumes.set(id, volume);
    this.setMuted(id, this.muted.has(id));
  }

  volume(id: string): number {
    return this.volumes.get(id) ?? 1;
  }

  /** What a moderator's mute does: nobody's page plays them. */
  private setMuted(id: string, muted: boolean): void {
    this.muted[muted ? "add" : "delete"](id);
    const sound = this.sounds.get(id);
    if (sound) sound.loudness = this.loudness(id);
  }

  private loudness(id: string): number {
    return this.muted.has(id) ? 0 : this.volume(id);
  }

  /** Whether somebody's voice could be heard now. */
  state(id: string): RTCPeerConnectionState {
    return this.lines?.state(id) ?? "new";
  }

  /** Look whose voice arrives; says whether it is others than before. */
  watch(now: number): boolean {
    return this.arrivals.look(this.others, (id) => this.state(id), now);
  }

  /** Whether somebody speaks whom one cannot hear. */
  lacks(id: string): boolean {
    return this.arrivals.lacks(id);
  }

  /** Sound of one person before it is placed, for tests: the greatest sample of the last moment. */
  peak(id: string): number {
    return this.sounds.get(id)?.peak() ?? 0;
  }

  close(): void {
    this.lines?.close();
    for (const id of [...this.sounds.keys()]) this.stop(id);
    this.loopback?.close();
    this.waker.close();
  }

  private use(lines: Lines): void {
    this.lines?.close();
    this.lines = lines;
    lines.speakInto(this.track);
  }
}
