/** A meeting: ties the line, the people, their voices and the picture together. */

import { Board } from "./board.js";
import { EYES_M, SEATED_M } from "./body.js";
import { Brought } from "./brought.js";
import { Controls } from "./controls.js";
import { FaceCamera } from "./face.js";
import { Headset } from "./headset.js";
import { sentence } from "./join.js";
import { Line } from "./line.js";
import type { Microphone } from "./microphone.js";
import { Offering } from "./offering.js";
import { Idle } from "./own.js";
import { People, type Known } from "./people.js";
import { Place } from "./place.js";
import { Pointers } from "./pointers.js";
import { FLAG, type Message } from "./protocol.js";
import { Replaying } from "./replaying.js";
import { Sharing } from "./sharing.js";
import { Sidebar } from "./sidebar.js";
import { Stance } from "./stance.js";
import type { Answer, Welcome } from "./texts.js";
import { View } from "./view.js";
import { Voice } from "./voice.js";
import { Walk } from "./walk.js";

const HERTZ = 30;
/** The last states of all come right behind the welcome; a newcomer waits so long to see who stands where. */
const FIRST_TICK_MS = 150;

const find = <T extends HTMLElement>(id: string): T => document.querySelector<T>(`#${id}`)!;

export class Meeting {
  readonly voice: Voice;
  own: Welcome | undefined;
  /** The newest state that was sent. */
  sent: Message | undefined;
  /** Whether pictures are drawn; tests without a graphics card leave the processor to the rest. */
  drawing = true;
  readonly board: Board;
  readonly sharing: Sharing;
  private readonly offering: Offering;
  private readonly view: View;
  private readonly pointers: Pointers;
  private readonly walk: Walk;
  private readonly headset: Headset;
  private readonly idle = new Idle();
  private readonly brought: Brought;
  private readonly people: People;
  private readonly stance: Stance;
  private readonly controls: Controls;
  private readonly replaying = new Replaying((said) => this.line.say(said));
  private readonly sidebar: Sidebar;
  private readonly line: Line;
  private camera: FaceCamera | undefined;
  private placed = false;
  private placedBy = Infinity;
  private drawn = performance.now();
  private moved = performance.now();
  private locked = false;

  constructor(
    address: string,
    private readonly join: ConstructorParameters<typeof Line>[1],
    private readonly microphone: Microphone | undefined,
    faceLink: string,
    echoes: boolean,
    private readonly meetingPlace: Place,
  ) {
    this.view = new View(find("view"), find("mirror"), meetingPlace);
    this.walk = new Walk(find("view"), meetingPlace.layout);
    this.stance = new Stance(this.walk);
    this.headset = new Headset(this.view.renderer, this.view.rig, this.walk, find("headset"), (text) => this.tell(text));
    this.pointers = new Pointers(this.view.scene, meetingPlace);
    this.board = new Board(meetingPlace.screens);
    this.sharing = new Sharing(
      (signal) => this.line.say(signal),
      (stream) => this.board.show(stream),
      () => this.offering.end(),
    );
    this.offering = new Offering(
      this.sharing,
      {
        sharer: () => this.people.others.find(({ person }) => person.shares)?.person.name,
        say: (on) => this.line.say({ kind: "share", on }),
        tell: (text) => this.tell(text),
      },
      meetingPlace.screens.length > 0,
    );
    this.voice = new Voice((signal) => this.line.say(signal), { echoes });
    this.voice.speakInto(microphone?.stream);
    this.sidebar = new Sidebar(
      this.voice,
      (action, number) => this.line.say({ kind: "moderate", action, number }),
      (text) => this.line.say({ kind: "chat", text }),
    );
    this.line = new Line(address, join, {
      welcome: (welcome) => this.welcome(welcome),
      answer: (answer) => this.hear(answer),
      state: (number, message) => this.see(number, message),
      broken: () => this.tell("The connection broke; coming back …"),
      ended: (text) => this.end(text),
    });
    this.brought = new Brought(`${location.pathname}/avatar`, join.key, join.secret, () => this.line.say({ kind: "undress" }));
    this.people = new People(this.view, this.brought);
    this.controls = new Controls(microphone, faceLink, {
      say: (said) => this.line.say(said),
      neutral: () => this.camera?.neutral(),
      sit: () => this.sit(),
      gesture: (number, again) => this.gesture(again && number === this.stance.animation ? 0 : number),
      lock: () => this.line.say({ kind: "moderate", action: this.locked ? "unlock" : "lock" }),
      consent: () => this.consent(),
      leave: () => this.leave(),
    });
    find("meeting").hidden = false;
    find("view").hidden = false;
    find("mirror").hidden = false;
    this.view.start(() => this.draw());
    // a timer, not the picture: a hidden tab still speaks and stands somewhere, if more slowly
    setInterval(() => this.move(), 1000 / HERTZ);
  }

  /** Everybody by their number. */
  get known(): ReadonlyMap<number, Known> {
    return this.people.known;
  }

  async watch(): Promise<void> {
    try {
      this.camera = await FaceCamera.ask();
      find("neutral").hidden = false;
    } catch (error) {
      this.tell(`No camera: ${sentence(error)}`);
    }
  }

  /** Wear a file of one's own. */
  bring(file: File): Promise<void> {
    return this.brought.wear(file);
  }

  private welcome(welcome: Welcome): void {
    this.own = welcome;
    this.placedBy = performance.now() + FIRST_TICK_MS;
    this.voice.configure(welcome.ice, welcome.engine);
    this.sharing.configure(welcome.ice);
    this.people.clear();
    this.people.own = welcome.number;
    for (const person of welcome.people) this.people.meet(person);
    this.brought.again();
    this.locked = welcome.locked;
    this.tell(this.meetingPlace.word);
    if (this.sharing.shares) this.line.say({ kind: "share", on: true }); // a server that started anew forgot it
    this.line.say({ kind: "voice", open: this.microphone?.isOpen ?? false });
    this.show();
  }

  private hear(answer: Answer): void {
    switch (answer.kind) {
      case "person":
        this.people.meet(answer.person);
        break;
      case "left":
        this.voice.part(this.people.part(answer.number)?.id ?? "");
        this.pointers.drop(answer.number);
        break;
      case "line":
        this.sidebar.line(answer.name, answer.text, answer.time_s);
        return;
      case "door":
        this.locked = answer.locked;
        this.tell(answer.locked ? "A moderator has locked the room: nobody new comes in." : "The room is open.");
        break;
      case "signal": {
        const { sender, signal } = answer;
        const person = typeof sender === "string" ? undefined : this.known.get(sender)?.person;
        const from = typeof sender === "string" ? sender : person?.id;
        if (signal.plane === "screen") person && void this.sharing.hear(person, signal);
        else if (from) void this.voice.hear(from, signal);
        return;
      }
      case "playing":
        this.replaying.hear(answer);
        return;
      case "engine":
      case "heard":
        this.voice.engine(answer);
        this.tell("");
        return;
      case "notice":
      case "refused":
        this.tell(answer.text);
        return;
      default:
        return;
    }
    this.show();
  }

  private see(number: number, message: Message): void {
    const known = this.known.get(number);
    if (!known) return;
    known.newest = message;
    known.playback.push(message, performance.now());
    if (number === this.own?.number && !this.placed) {
      // the page was loaded anew: one stands where one stood
      [this.walk.x, this.walk.z, this.walk.heading] = [message.floor_m[0]!, message.floor_m[1]!, message.heading];
      this.placed = true;
    }
    const speaking = (message.flags & FLAG.speaking) !== 0;
    known.figure?.speak(speaking);
    this.sidebar.speak(number, speaking);
  }

  /** Thirty times a second: say how one looks and where one stands. */
  private move(): void {
    const now = performance.now();
    if (!this.own || !this.stand(now)) return;
    const seconds = Math.min(0.2, (now - this.moved) / 1000);
    this.moved = now;
    if (!this.headset.worn) this.walk.update(this.stance.seated ? 0 : seconds);
    if (this.stance.isOver(now / 1000)) this.gesture(0);
    const speaking = this.microphone?.speaking ?? false;
    const idle = this.idle.update(seconds, speaking ? this.microphone!.level : 0);
    const message = { ...this.stance.state(this.camera?.face(now) ?? idle, speaking), ...this.headset.update(seconds) };
    if (message.left_hand ?? message.right_hand) message.flags |= FLAG.hands;
    this.sent = { ...message, sequence: 0, time_ms: 0, weights: Float64Array.from(message.weights) };
    this.line.move(message);
    this.place(now);
    if (this.camera?.word) this.tell(this.camera.word);
    else if (this.camera) this.tell("");
  }

  /** Find a place that is free, once it is known where the others are; says whether one stands. */
  private stand(now: number): boolean {
    if (!this.placed && now > this.placedBy) {
      Object.assign(this.walk, this.meetingPlace.layout.freePlace(this.people.taken(), this.own?.replay));
      this.placed = true;
    }
    return this.placed;
  }

  /** Put voices and ears where heads are; with the timer, as voices of a hidden tab go on. */
  private place(now: number): void {
    for (const { person, playback } of this.people.others) {
      const shown = playback.at(now);
      if (!shown) continue;
      const height = shown.flags & FLAG.seated ? SEATED_M : EYES_M;
      this.voice.place(person.id, { x: shown.floor_m[0]!, y: height, z: shown.floor_m[1]! });
    }
    const { x, z, heading } = this.walk;
    const { at, heading: turned } = this.headset.ears() ?? { at: { x, y: this.stance.eyes_m, z }, heading };
    this.voice.listen(at, turned);
  }

  private draw(): void {
    const now = performance.now();
    const seconds = Math.min(0.1, (now - this.drawn) / 1000);
    this.drawn = now;
    this.stance.rise(seconds);
    this.headset.look();
    this.view.look(this.walk.x, this.walk.z, this.stance.eyes_m, this.walk.heading, this.walk.pitch);
    for (const [number, { person, playback, figure }] of this.known) {
      const shown = playback.at(now);
      if (!figure || !shown) continue;
      figure.root.visible = true;
      const self = number === this.own?.number;
      // one's own picture shows what is sent, as a mirror that lags is worse than none; but a program's face only comes back
      const mine = self && person.face === "page" ? this.sent : undefined;
      figure.show(mine ?? shown, seconds, this.view.eye);
      this.pointers.show(number, mine ?? shown, figure, this.view.eye, self);
      if (self) continue;
      figure.call(person, (shown.flags & FLAG.tracked) !== 0);
    }
    this.replaying.show();
    if (this.drawing) this.view.draw();
  }

  private show(): void {
    if (!this.own) return;
    const people = this.people.all;
    this.sidebar.list(people, this.own.number, this.own.moderator);
    this.voice.meet(people, this.own.id);
    this.sharing.meet(people, this.own.id);
    this.offering.follow();
    this.controls.show(this.own, people, this.locked);
  }

  /** Agree to be recorded, or no longer; also after a break of the line. */
  private consent(): void {
    const recorded = !this.known.get(this.own?.number ?? -1)?.person.recorded;
    this.join.recorded = recorded;
    this.line.say({ kind: "consent", recorded });
  }

  private leave(): void {
    this.line.leave();
    this.end("You have left. Load the page again to come back.");
  }

  private sit(): void {
    if (!this.stance.sit(this.people.taken())) return this.tell("No free seat is near; walk to one.");
    this.controls.seat(this.stance.seated);
    this.tell("");
  }

  private gesture(number: number): void {
    this.stance.gesture(number, performance.now() / 1000);
    this.controls.gesture(number);
  }

  private tell(text: string): void {
    find("state").textContent = text || this.voice.word;
  }

  private end(text: string): void {
    this.voice.close();
    this.sharing.close();
    this.offering.follow();
    this.microphone?.close();
    this.camera?.close();
    this.own = undefined;
    this.people.clear();
    find("mirror").hidden = true;
    find("people").replaceChildren();
    document.querySelector("nav")!.hidden = true; // nothing to do here any more; what was said can still be read
    this.tell(text);
  }
}
