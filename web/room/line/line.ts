/** Holds the connection to the room: comes in, comes back by itself after a break, and says what happened. */

import { decode, encode, unpack, ProtocolError, type Message } from "./protocol.js";
import type { Answer, Said, Welcome } from "./texts.js";

/** A server that starts again is back in a second: short waits first, and never so long that people miss three seconds of it. */
const WAITS_MS = [200, 400, 800, 1000, 2000];

/**
 * A try that brought no welcome by then is given up: no network that carries a voice takes so long. A server under load may,
 * and would never let anybody in: each try that was given up lets the next one take twice as long, up to the last of these.
 */
const PATIENCE_MS = [4000, 8000, 16_000];

/**
 * Milliseconds without a word from the server, which gives each state back within a tick, until the line counts as broken. Of
 * a network that is gone a socket says nothing for minutes. Behind `online` a second is enough.
 */
const SILENT_MS = { most: 10_000, online: 1000 };
/** States that must have gone unanswered: a page that was halted for a while has not sent any. */
const FEWEST_UNANSWERED = 3;

export interface Handlers {
  welcome(welcome: Welcome): void;
  answer(answer: Answer): void;
  state(number: number, message: Message): void;
  /** The connection ended, or did not come about; it is tried again. */
  broken(): void;
  /** The room has closed the door; the sentence says why. */
  ended(text: string): void;
}

export class Line {
  private socket: WebSocket | undefined;
  private open = false;
  private ended = false;
  /** Whether the room has said why the newest socket ends. */
  private refused = false;
  private tries = 0;
  /** Tries that were given up since the last welcome. */
  private late = 0;
  private sequence = 0;
  private unanswered = 0;
  /** When the server was heard last, and when the first state behind that went out. */
  private heardAt = 0;
  private askedAt = 0;

  constructor(
    private readonly address: string,
    private readonly join: Extract<Said, { kind: "join" }>,
    private readonly handlers: Handlers,
  ) {
    this.connect();
    // a laptop that wakes up, or changes networks, need not wait for the next try
    addEventListener("online", () => {
      this.late = 0; // tries of a network that was gone say nothing of the server
      if (!this.open) {
        this.drop(); // begun on a network that is gone
        return this.connect();
      }
      const [back, socket] = [performance.now(), this.socket];
      setTimeout(() => this.socket === socket && this.heardAt <= back && this.abandon(0), SILENT_MS.online);
    });
  }

  /** Say something; false where the line is broken, and it was not said. */
  say(said: Said): boolean {
    if (this.open) this.socket!.send(JSON.stringify(said));
    return this.open;
  }

  /** Send this person's state, unless the last ones have not gone yet: newer ones say more. */
  move(message: Omit<Message, "sequence" | "time_ms">): void {
    if (!this.open) return;
    if (this.unanswered++ === 0) this.askedAt = performance.now();
    if (this.abandon(SILENT_MS.most) || this.socket!.bufferedAmount > 4096) return;
    this.sequence = (this.sequence + 1) % 2 ** 16;
    this.socket!.send(encode({ ...message, sequence: this.sequence, time_ms: Math.round(performance.now()) }));
  }

  leave(): void {
    this.say({ kind: "leave" });
    this.ended = true;
    this.socket?.close();
  }

  private connect(): void {
    if (this.ended || (this.socket && this.socket.readyState <= WebSocket.OPEN)) return;
    const socket = new WebSocket(this.address);
    this.socket = socket;
    this.refused = false;
    this.limit(socket);
    socket.binaryType = "arraybuffer";
    socket.addEventListener("open", () => socket.send(JSON.stringify({ ...this.join, at_ms: Date.now() })));
    socket.addEventListener("message", ({ data }) => {
      if (socket !== this.socket) return;
      [this.unanswered, this.heardAt] = [0, performance.now()];
      if (typeof data === "string") this.hear(JSON.parse(data) as Answer);
      else this.see(new Uint8Array(data as ArrayBuffer));
    });
    socket.addEventListener("close", () => socket === this.socket && this.closed());
  }

  private hear(answer: Answer): void {
    if (answer.kind === "welcome") {
      this.open = true;
      this.tries = this.late = 0;
      this.handlers.welcome(answer);
    } else if (answer.kind === "refused") {
      this.ended = !answer.again;
      this.refused = true;
      if (this.ended) this.handlers.ended(answer.text);
      else this.handlers.answer(answer);
    } else {
      this.handlers.answer(answer);
    }
  }

  private see(content: Uint8Array): void {
    try {
      for (const [number, state] of unpack(content).states) this.handlers.state(number, decode(state));
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.ended = true;
      this.socket?.close();
      this.handlers.ended("The room speaks another version than this page; load the page again.");
    }
  }

  /** Give a try up that takes too long. A page that was halted meanwhile hears first what has come: it gets a second more. */
  private limit(socket: WebSocket): void {
    const waits = (): boolean => this.socket === socket && !this.open;
    const late = (): void => {
      if (!waits()) return;
      this.late++;
      this.drop();
      this.closed();
    };
    const patience = PATIENCE_MS[Math.min(this.late, PATIENCE_MS.length - 1)]!;
    setTimeout(() => waits() && setTimeout(late, SILENT_MS.online), patience);
  }

  /** Give a socket up that states went into for so long without a word back; whether it was. */
  private abandon(silentMs: number): boolean {
    if (this.unanswered < FEWEST_UNANSWERED || performance.now() - this.askedAt < silentMs) return false;
    this.drop();
    this.closed();
    return true;
  }

  /** Let go of a socket, whatever it still says. */
  private drop(): void {
    const dead = this.socket;
    this.socket = undefined;
    dead?.close();
  }

  private closed(): void {
    this.open = false;
    this.unanswered = 0;
    if (this.ended) return;
    if (!this.refused) this.handlers.broken();
    const wait = WAITS_MS[Math.min(this.tries++, WAITS_MS.length - 1)]!;
    setTimeout(() => this.connect(), wait);
  }
}
