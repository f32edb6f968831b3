/** The page of a room: asks who comes, then ties the line, the people, their voices and the picture together. */

import type { Quaternion } from "three";

import { rotation } from "../avatar/index.js";
import { Wardrobe, type Dressed } from "./avatars.js";
import { EYES_M, SEATED_M } from "./body.js";
import { Brought } from "./brought.js";
import { coloursOf, dye } from "./colours.js";
import { FaceCamera } from "./face.js";
import { Figure } from "./figure.js";
import { Headset } from "./headset.js";
import { about, ask, randomText, readLink, secretOf, sentence } from "./join.js";
import { Line } from "./line.js";
import { Offering } from "./offering.js";
import { Idle, type OwnFace } from "./own.js";
import { Board } from "./board.js";
import { Place } from "./place.js";
import { Playback } from "./playback.js";
import { Pointers } from "./pointers.js";
import { ANIMATIONS, FLAG, POINTER, type Message } from "./protocol.js";
import { Replaying } from "./replaying.js";
import { Sharing } from "./sharing.js";
import { Sidebar } from "./sidebar.js";
import type { Answer, Person, Welcome } from "./texts.js";
import { View } from "./view.js";
import { Voice } from "./voice.js";
import { Walk } from "./walk.js";

const HERTZ = 30;
/** The last states of all come right behind the welcome; a newcomer waits so long to see who stands where. */
const FIRST_TICK_MS = 150;
/** A gesture lasts so long; a raised hand and pointing stay until they are ended. */
const GESTURE_S = 2.2;
const STAYS = new Set(["point", "raise hand", "pointer"]);

const find = <T extends HTMLElement>(id: string): T => document.querySelector<T>(`#${id}`)!;

/** Somebody else, or oneself, as this page knows them. */
interface Known {
  person: Person;
  readonly playback: Playback;
  figure: Figure | undefined;
  wears: string;
  /** Frees what an avatar of their own holds. */
  free: () => void;
  newest: Message | undefined;
}

class Meeting {
  readonly voice: Voice;
  readonly known = new Map<number, Known>();
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
  private readonly wardrobe = new Wardrobe();
  private readonly idle = new Idle();
  private readonly brought: Brought;
  private readonly replaying = new Replaying((said) => this.line.say(said));
  private readonly sidebar: Sidebar;
  private readonly line: Line;
  private camera: FaceCamera | undefined;
  private placed = false;
  private placedBy = Infinity;
  private seated = false;
  private animation = 0;
  private animationEnds = Infinity;
  private drawn = performance.now();
  private moved = performance.now();
  private locked = false;
  private standing = EYES_M;

  constructor(
    address: string,
    private readonly join: ConstructorParameters<typeof Line>[1],
    private readonly microphone: Awaited<ReturnType<typeof ask>>["microphone"],
    private readonly faceLink: string,
    echoes: boolean,
    private readonly meetingPlace: Place,
  ) {
    this.view = new View(find("view"), find("mirror"), meetingPlace);
    this.walk = new Walk(find("view"), meetingPlace.layout);
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
        sharer: () => [...this.known.values()].find(({ person }) => person.shares && person.number !== this.own?.number)?.person.name,
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
    this.controls();
    find("meeting").hidden = false;
    find("view").hidden = false;
    find("mirror").hidden = false;
    this.view.start(() => this.draw());
    // a timer, not the picture: a hidden tab still speaks and stands somewhere, if more slowly
    setInterval(() => this.move(), 1000 / HERTZ);
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
    for (const known of this.known.values()) undress(known);
    this.known.clear();
    for (const person of welcome.people) this.meet(person);
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
        this.meet(answer.person);
        break;
      case "left": {
        const known = this.known.get(answer.number);
        this.voice.part(known?.person.id ?? "");
        this.pointers.drop(answer.number);
        if (known) undress(known);
        this.known.delete(answer.number);
        break;
      }
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

  private meet(person: Person): void {
    const known = this.known.get(person.number) ?? {
      person,
      playback: new Playback(),
      figure: undefined,
      wears: "",
      free: () => undefined,
      newest: undefined,
    };
    if (known.person.face !== person.face) known.playback.restart(); // their clocks differ
    known.person = person;
    this.known.set(person.number, known);
    if (person.number === this.own?.number) this.brought.wears(person.own);
    const wears = `${person.avatar} ${person.own}`;
    if (known.wears === wears) return;
    known.wears = wears;
    void this.clothe(known, person, wears);
  }

  /** The plain head until the room's avatar is there, and that one until the person's own is. */
  private async clothe(known: Known, person: Person, wears: string): Promise<void> {
    const still = (): boolean => this.known.get(person.number) === known && known.wears === wears;
    const own = person.own ? this.brought.fetch(person.own) : undefined;
    if (!known.figure || !person.own) this.dress(known, this.wardrobe.plain());
    const ready = await this.wardrobe.another(person.avatar);
    if (ready && still()) this.dress(known, ready, dye(ready.avatar.root, coloursOf(person)));
    const brought = await own;
    if (!brought) return;
    if (still()) this.dress(known, brought, () => brought.avatar.dispose());
    else brought.avatar.dispose();
  }

  private dress(known: Known, { avatar, height }: Dressed, free = (): void => undefined): void {
    undress(known);
    known.free = free;
    known.figure = new Figure(avatar, known.person.number, height);
    known.figure.root.visible = false; // until it is known where they stand
    this.view.scene.add(known.figure.root);
    if (known.person.number === this.own?.number) {
      known.figure.nameless();
      this.view.hide(known.figure.root);
    }
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
    if (!this.headset.worn) this.walk.update(this.seated ? 0 : seconds);
    if (now / 1000 > this.animationEnds) this.gesture(0);
    const speaking = this.microphone?.speaking ?? false;
    const idle = this.idle.update(seconds, speaking ? this.microphone!.level : 0);
    const message = { ...this.state(this.camera?.face(now) ?? idle, speaking), ...this.headset.update(seconds) };
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
      Object.assign(this.walk, this.meetingPlace.layout.freePlace(this.taken(), this.own?.replay));
      this.placed = true;
    }
    return this.placed;
  }

  /** Where the others stand. */
  private taken(): [number, number][] {
    const others = [...this.known.values()].filter(({ person }) => person.number !== this.own?.number);
    return others.flatMap(({ newest }): [number, number][] => (newest ? [[newest.floor_m[0]!, newest.floor_m[1]!]] : []));
  }

  /** Put voices and ears where heads are; with the timer, as voices of a hidden tab go on. */
  private place(now: number): void {
    for (const [number, { person, playback }] of this.known) {
      const shown = number === this.own?.number ? undefined : playback.at(now);
      if (!shown) continue;
      const height = shown.flags & FLAG.seated ? SEATED_M : EYES_M;
      this.voice.place(person.id, { x: shown.floor_m[0]!, y: height, z: shown.floor_m[1]! });
    }
    const { x, z, heading } = this.walk;
    const { at, heading: turned } = this.headset.ears() ?? { at: { x, y: this.standing, z }, heading };
    this.voice.listen(at, turned);
  }

  private state(face: OwnFace, speaking: boolean): Omit<Message, "sequence" | "time_ms"> {
    // who points turns the head along the ray: what others see pointed at is where the own dot is
    const [yaw, pitch, roll] = this.animation === POINTER ? [0, 0, 0] : face.head;
    const turn: Quaternion = rotation(yaw, pitch + this.walk.pitch, roll);
    return {
      flags: (speaking ? FLAG.speaking : 0) | (face.tracked ? FLAG.tracked : 0) | (this.seated ? FLAG.seated : 0),
      weights: face.weights,
      head_m: face.head_m,
      rotation: turn.toArray(),
      gaze: face.gaze,
      floor_m: [this.walk.x, this.walk.z],
      heading: this.walk.heading,
      animation: this.animation,
      left_hand: null,
      right_hand: null,
    };
  }

  private draw(): void {
    const now = performance.now();
    const seconds = Math.min(0.1, (now - this.drawn) / 1000);
    this.drawn = now;
    this.standing += ((this.seated ? SEATED_M : EYES_M) - this.standing) * (1 - Math.exp(-8 * seconds));
    this.headset.look();
    this.view.look(this.walk.x, this.walk.z, this.standing, this.walk.heading, this.walk.pitch);
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
    const people = [...this.known.values()].map(({ person }) => person);
    this.sidebar.list(people, this.own.number, this.own.moderator);
    this.voice.meet(people, this.own.id);
    this.sharing.meet(people, this.own.id);
    this.offering.follow();
    const sharer = people.find(({ shares }) => shares);
    const shared = find("shared");
    shared.hidden = !sharer;
    shared.textContent = sharer ? (sharer.id === this.own.id ? "You share the screen" : `${sharer.name} shares the screen`) : "";
    const lock = find<HTMLButtonElement>("lock");
    lock.hidden = !this.own.moderator;
    const own = this.known.get(this.own.number)?.person;
    const consent = find<HTMLButtonElement>("consent");
    consent.hidden = !this.own.recording;
    consent.textContent = own?.recorded ? "Record me no longer" : "Agree to be recorded";
    const mark = find("mark");
    mark.hidden = !this.own.replay && !own?.recorded;
    mark.textContent = this.own.replay ? "Replay" : "You are recorded";
    lock.textContent = this.locked ? "Unlock the room" : "Lock the room";
  }

  private controls(): void {
    const mute = find<HTMLButtonElement>("mute");
    const muted = (): void => {
      mute.textContent = this.microphone ? (this.microphone.isOpen ? "Mute me" : "Unmute me") : "No microphone";
      mute.disabled = !this.microphone;
      mute.setAttribute("aria-pressed", String(this.microphone ? !this.microphone.isOpen : false));
    };
    muted();
    mute.addEventListener("click", () => {
      this.microphone!.isOpen = !this.microphone!.isOpen;
      this.line.say({ kind: "voice", open: this.microphone!.isOpen });
      muted();
    });
    find("neutral").addEventListener("click", () => this.camera?.neutral());
    find("seat").addEventListener("click", () => this.sit());
    const gesture = find<HTMLSelectElement>("gesture");
    gesture.replaceChildren(
      ...ANIMATIONS.map((name, number) => new Option(number ? `${number} ${name}` : "Gesture …", String(number))),
    );
    gesture.addEventListener("change", () => {
      this.gesture(Number(gesture.value));
      gesture.blur();
    });
    addEventListener("keydown", ({ key, target, ctrlKey, metaKey, altKey }) => {
      const typing = target instanceof HTMLElement && target.closest("input, textarea, select");
      const number = Number(key);
      if (!typing && !ctrlKey && !metaKey && !altKey && Number.isInteger(number) && number >= 0 && number < ANIMATIONS.length && key.trim()) {
        this.gesture(this.animation === number ? 0 : number);
      }
    });
    find("program").addEventListener("click", () => {
      const command = `track --to 'room:${this.faceLink}'`;
      void navigator.clipboard?.writeText(command).catch(() => undefined);
      prompt("Copied. Run this on the machine with the camera or headset; whoever has this link moves your face:", command);
    });
    find("lock").addEventListener("click", () => this.line.say({ kind: "moderate", action: this.locked ? "unlock" : "lock" }));
    find("consent").addEventListener("click", () => {
      const recorded = !this.known.get(this.own?.number ?? -1)?.person.recorded;
      this.join.recorded = recorded; // also after a break
      this.line.say({ kind: "consent", recorded });
    });
    find("leave").addEventListener("click", () => {
      this.line.leave();
      this.end("You have left. Load the page again to come back.");
    });
  }

  /** Sit on the nearest free seat, or stand up. */
  private sit(): void {
    const seat = this.seated ? undefined : this.meetingPlace.layout.freeSeat(this.walk.x, this.walk.z, this.taken());
    if (!this.seated && !seat) return this.tell("No free seat is near; walk to one.");
    if (seat) Object.assign(this.walk, seat);
    this.seated = !this.seated;
    find("seat").textContent = this.seated ? "Stand up" : "Sit";
    this.tell("");
  }

  private gesture(number: number): void {
    this.animation = number;
    this.animationEnds = number && !STAYS.has(ANIMATIONS[number]!) ? performance.now() / 1000 + GESTURE_S : Infinity;
    find<HTMLSelectElement>("gesture").value = String(number);
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
    for (const known of this.known.values()) undress(known);
    this.known.clear();
    find("mirror").hidden = true;
    find("people").replaceChildren();
    document.querySelector("nav")!.hidden = true; // nothing to do here any more; what was said can still be read
    this.tell(text);
  }
}

function undress(known: Known): void {
  known.figure?.dispose();
  known.free();
  known.figure = undefined;
}

async function main(): Promise<void> {
  const link = readLink();
  if (!link) {
    find("word").textContent = "This link is not whole: it ends with # and 22 characters. Ask for it again.";
    find("join").querySelector("button")!.disabled = true;
    return;
  }
  const place = Place.load(link.room); // while the person fills in the form
  const choice = await ask(await Wardrobe.names(), await about(link));
  const secret = secretOf(link);
  const visit = randomText(9);
  const { protocol, host, origin } = location;
  const meeting = new Meeting(
    `${protocol === "https:" ? "wss" : "ws"}://${host}/room/${link.room}/socket`,
    { kind: "join", version: 1, key: link.key, secret, name: choice.name, avatar: choice.avatar, visit, role: "page", recorded: choice.recorded },
    choice.microphone,
    `${origin}/room/${link.room}#${link.key}.${secret}`,
    choice.echoes,
    await place,
  );
  if (choice.camera) await meeting.watch();
  if (choice.own) void meeting.bring(choice.own);
  Object.assign(globalThis, { meeting }); // for tests, and for who looks into the page
}

void main();
