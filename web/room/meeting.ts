/** A meeting: ties the line, the people, their voices and the picture together. */

import { byId } from "../elements.js";
import { sentence } from "./door/join.js";
import { Line } from "./line/line.js";
import { FLAG, type Message } from "./line/protocol.js";
import type { Answer, Welcome } from "./line/texts.js";
import { Controls } from "./page/controls.js";
import { newsOf } from "./page/news.js";
import { Raised } from "./page/raised.js";
import { Replaying } from "./page/replaying.js";
import { Sidebar } from "./page/sidebar.js";
import { Status } from "./page/status.js";
import { Brought } from "./people/brought.js";
import { People, type Known } from "./people/people.js";
import { Presence } from "./presence/presence.js";
import { Place } from "./scene/place.js";
import { Screen } from "./sharing/screen.js";
import { Stage } from "./stage.js";
import type { Microphone } from "./voice/microphone.js";
import { Voice } from "./voice/voice.js";

const HERTZ = 30;

export class Meeting {
  readonly voice: Voice;
  own: Welcome | undefined;
  readonly screen: Screen;
  readonly stage: Stage;
  readonly presence: Presence;
  readonly brought: Brought;
  private readonly people: People;
  private readonly controls: Controls;
  private readonly replaying = new Replaying((said) => this.line.say(said));
  private readonly sidebar: Sidebar;
  private readonly raised = new Raised();
  private readonly line: Line;
  private readonly status = new Status(byId("state"), () => [
    this.lineWord,
    this.microphone?.word ?? "",
    this.voice.word,
    this.presence.camera?.word ?? "",
    this.cameraWord,
  ]);
  private lineWord = "Connecting …";
  private cameraWord = "";
  private locked = false;

  constructor(
    address: string,
    private readonly join: ConstructorParameters<typeof Line>[1],
    private readonly microphone: Microphone | undefined,
    faceLink: string,
    echoes: boolean,
    private readonly meetingPlace: Place,
  ) {
    this.stage = new Stage(byId("view"), byId("mirror"), meetingPlace);
    this.presence = new Presence(byId("view"), byId("headset"), this.stage.view, meetingPlace, microphone, (text) => this.tell(text));
    this.screen = new Screen(
      meetingPlace.screens,
      () => this.people,
      (said) => this.line.say(said),
      (text) => this.tell(text),
    );
    this.voice = new Voice((signal) => this.line.say(signal), { echoes });
    this.voice.speakInto(microphone?.stream);
    this.sidebar = new Sidebar(
      this.voice,
      (action, { number, id }) => this.line.say({ kind: "moderate", action, number, id }),
      (text) => this.chat(text),
    );
    this.line = new Line(address, join, {
      welcome: (welcome) => this.welcome(welcome),
      answer: (answer) => this.hear(answer),
      state: (number, message) => this.see(number, message),
      broken: () => (this.lineWord = this.own ? "The connection broke; coming back …" : "The room cannot be reached; trying again …"),
      ended: (text) => this.end(text),
    });
    this.brought = new Brought(`${location.pathname}/avatar`, join.key, join.secret, () => this.line.say({ kind: "undress" }));
    this.people = new People(this.stage.view, this.brought);
    this.controls = new Controls(microphone, faceLink, {
      say: (said) => this.line.say(said),
      neutral: () => this.presence.camera?.neutral(),
      sit: () => this.tell(this.presence.sit(this.people.taken())),
      gesture: (number, again) => this.gesture(again && number === this.presence.stance.animation ? 0 : number),
      lock: () => this.line.say({ kind: "moderate", action: this.locked ? "unlock" : "lock" }),
      consent: () => this.consent(),
      leave: () => {
        this.line.leave();
        this.end("You have left. Load the page again to come back.");
      },
    });
    byId("meeting").hidden = false;
    this.stage.begin(() => {
      this.stage.draw(this.people, this.presence);
      this.replaying.show();
    });
    // a timer, not the picture: a hidden tab still speaks and stands somewhere, if more slowly
    setInterval(() => this.move(), 1000 / HERTZ);
  }

  /** Everybody by their number. */
  get known(): ReadonlyMap<number, Known> {
    return this.people.known;
  }

  async watch(): Promise<void> {
    try {
      byId("neutral").hidden = !(await this.presence.watch());
    } catch (error) {
      this.cameraWord = `No camera: ${sentence(error, "load the page again")}`;
    }
  }

  private welcome(welcome: Welcome): void {
    this.own = welcome;
    this.presence.arrive(performance.now());
    this.voice.configure(welcome.ice, welcome.engine);
    this.people.welcome(welcome.people, welcome.number);
    this.stage.pointers.clear();
    this.raised.clear();
    for (const { number } of welcome.people) this.speak(number, false); // in mid-word when the line broke, perhaps
    this.brought.again();
    this.locked = welcome.locked;
    this.lineWord = "";
    if (this.meetingPlace.word) this.tell(this.meetingPlace.word);
    this.asked(welcome.recording);
    this.screen.configure(welcome.ice);
    this.line.say({ kind: "voice", open: this.microphone?.isOpen ?? false });
    this.show();
  }

  private hear(answer: Answer): void {
    switch (answer.kind) {
      case "person": {
        const before = this.people.self;
        this.people.meet(answer.person);
        const wants = { shares: this.screen.sharing.shares, wears: this.brought.wanted };
        if (!answer.person.present || !answer.person.voice) this.speak(answer.person.number, false); // in mid-word, perhaps
        const news = answer.person.id === before?.id ? newsOf(before, answer.person, wants) : "";
        if (news) this.tell(news);
        break;
      }
      case "left":
        this.voice.part(this.people.part(answer.number)?.id ?? "");
        this.stage.pointers.drop(answer.number);
        this.raised.drop(answer.number);
        break;
      case "line":
        this.sidebar.line(answer);
        return;
      case "door":
        this.locked = answer.locked;
        this.tell(answer.locked ? "A moderator has locked the room: nobody new comes in." : "The room is open.");
        break;
      case "signal": {
        const { sender, signal } = answer;
        const person = typeof sender === "string" ? undefined : this.known.get(sender)?.person;
        const from = typeof sender === "string" ? sender : person?.id;
        if (signal.plane === "screen") person && this.screen.hear(person, signal);
        else if (from) void this.voice.hear(from, signal);
        return;
      }
      case "playing":
        this.replaying.hear(answer);
        return;
      case "engine":
      case "heard":
        this.voice.engine(answer);
        return;
      case "notice":
      case "refused":
        if (answer.kind === "refused") return void (this.lineWord = answer.text);
        if (answer.about === "share") this.screen.refuse();
        if (answer.about === "chat") this.sidebar.unsaid();
        if (answer.about === "consent" && this.own) this.own.recording = ""; // it has ended: there is nothing to agree to
        this.tell(answer.text);
        break;
    }
    this.show();
  }

  private see(number: number, message: Message): void {
    const known = this.known.get(number);
    if (!known) return;
    known.newest = message;
    known.playback.push(message, performance.now());
    if (number === this.own?.number) this.presence.resume(message);
    const raised = this.raised.see(number, message, performance.now());
    if (raised) this.show();
    if (raised === "up" && this.own?.moderator && number !== this.own.number) this.tell(`${known.person.name} raises a hand.`);
    this.speak(number, (message.flags & FLAG.speaking) !== 0);
  }

  private speak(number: number, speaking: boolean): void {
    this.known.get(number)?.figure?.speak(speaking);
    this.sidebar.speak(number, speaking);
  }

  /** Thirty times a second: say how one looks and where one stands. */
  private move(): void {
    const now = performance.now();
    this.status.show(now);
    if (!this.own || !this.presence.stand(now, this.people.taken(), this.own.replay)) return;
    if (this.presence.stance.isOver(now / 1000)) this.gesture(0);
    this.controls.seat(this.presence.stance.seated);
    this.line.move(this.presence.move(now));
    this.presence.listen(this.voice, this.people.others, now);
    if (this.voice.watch(now)) this.show();
  }

  private show(): void {
    if (!this.own) return;
    const people = this.people.all;
    this.sidebar.list(people, this.own.number, this.own.moderator, this.raised);
    this.voice.meet(people, this.own.id);
    this.screen.meet(people, this.own.id);
    this.controls.show(this.own, people, this.locked);
  }

  /** A yes counts for the recording that was asked about: of another one its person is asked anew, and not in it meanwhile. */
  private asked(recording: string): void {
    if (recording === this.join.recording) return;
    if (recording) this.tell('This room is recorded from now on, or by another recording. You are not in it; "Agree to be recorded" changes that.');
    this.join.recorded = false;
    this.join.recording = recording;
  }

  /** Agree to be recorded, or no longer; also after a break of the line. */
  private consent(): void {
    const recorded = !this.people.self?.recorded;
    this.join.recorded = recorded;
    this.join.recording = this.own?.recording ?? "";
    this.line.say({ kind: "consent", recorded });
  }

  private chat(text: string): boolean {
    const sent = this.line.say({ kind: "chat", text });
    if (!sent) this.tell("Not sent: the connection is broken; press Enter again when it is back.");
    return sent;
  }

  private gesture(number: number): void {
    this.presence.stance.gesture(number, performance.now() / 1000);
    this.controls.gesture(number);
  }

  private tell(text: string): void {
    this.status.tell(text, performance.now());
  }

  private end(text: string): void {
    this.voice.close();
    this.screen.close();
    this.microphone?.close();
    this.presence.end();
    this.own = undefined;
    this.people.clear();
    this.stage.pointers.clear();
    this.stage.end();
    byId("people").replaceChildren();
    // nothing to do here any more; what was said can still be read
    for (const part of document.querySelectorAll<HTMLElement>("nav, #mark, #shared, #replay, #chat")) part.hidden = true;
    this.brought.end();
    this.status.end(text, performance.now());
  }
}
