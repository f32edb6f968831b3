/** The line to the server, which comes back by itself. */

import { VERSION, type Command, type Frame, type Hello, type Message } from "./messages.js";

/** Between tries: at once at first, then ever more slowly. */
const PAUSES_S = [0.5, 1, 2, 4, 5];
/** Without a frame for so long, nothing comes from the cameras. */
const SILENT_S = 2;
/** WebSocket's word for a server that ends on purpose. */
const GOING_AWAY = 1001;
/** HTTP's status where the link's token is another one, and where as many tabs look as may. */
const FORBIDDEN = 403;
const UNAVAILABLE = 503;

export type State = "connecting" | "live" | "waiting" | "lost";

export interface Listener {
  state(state: State, sentence: string): void;
  hello(hello: Hello): void;
  frame(frame: Frame): void;
  picture(camera: number, jpeg: Blob): void;
  refused(sentence: string): void;
}

export class Connection {
  private socket: WebSocket | undefined;
  private tries = 0;
  private silence = 0;
  private again = 0;
  private resting = false;

  constructor(private readonly listener: Listener) {
    this.open();
  }

  send(command: Command): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  /** Let the line go while nobody looks: a session without a line makes neither frames nor pictures for it. */
  rest(): void {
    if (this.resting) return;
    this.resting = true;
    clearTimeout(this.silence);
    clearTimeout(this.again);
    const { socket } = this;
    this.socket = undefined;
    socket?.close();
  }

  /** Take it up again. */
  goOn(): void {
    if (!this.resting) return;
    this.resting = false;
    this.open();
  }

  private open(): void {
    const address = new URL(`stream${location.search}`, location.href);
    address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(address);
    socket.binaryType = "arraybuffer";
    // one that was let go has no more to say
    socket.addEventListener("message", ({ data }) => void (socket === this.socket && this.hear(data)));
    socket.addEventListener("close", ({ code }) => void (socket === this.socket && this.closed(code)));
    this.socket = socket;
  }

  private hear(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      const camera = new Uint8Array(data, 0, 1)[0]!;
      this.listener.picture(camera, new Blob([new Uint8Array(data, 1)], { type: "image/jpeg" }));
      return;
    }
    const message = JSON.parse(data) as Message;
    if (message.type === "frame") {
      this.send({ verb: "seen", value: message.number });
      this.listener.state("live", "Live");
      this.expect();
      this.listener.frame(message);
    } else if (message.type === "hello") {
      this.tries = 0;
      if (message.version !== VERSION) {
        this.listener.refused("This page is of another version than track: load it again.");
      }
      this.listener.state("waiting", "Waiting for the camera");
      this.listener.hello(message);
    } else {
      this.listener.refused(message.text);
    }
  }

  /** Say so where no further frame comes. */
  private expect(): void {
    clearTimeout(this.silence);
    this.silence = setTimeout(() => this.listener.state("waiting", "Nothing comes from the camera"), 1000 * SILENT_S);
  }

  private closed(code: number): void {
    clearTimeout(this.silence);
    const pause = PAUSES_S[Math.min(this.tries++, PAUSES_S.length - 1)]!;
    void this.lost(code === GOING_AWAY ? "track has ended" : "track does not answer");
    this.again = setTimeout(() => this.open(), 1000 * pause);
  }

  /** Say why; a socket does not tell how it was refused, and the same address without one does. */
  private async lost(why: string): Promise<void> {
    const address = new URL(`stream${location.search}`, location.href);
    const answer = this.tries > 1 ? await fetch(address).catch(() => undefined) : undefined;
    const refusal = answer?.status === UNAVAILABLE ? (await answer.text().catch(() => "")).trim() : "";
    if (this.resting || this.socket?.readyState === WebSocket.OPEN) return;
    let sentence = `${refusal || why}; this page goes on when ${refusal ? "there is room" : "it is there again"}`;
    if (answer?.status === FORBIDDEN) sentence = "track has another link by now: open the one that it printed last";
    this.listener.state("lost", sentence);
  }
}
