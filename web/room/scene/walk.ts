/** Moves one's own body: keys or a thumb on the floor to walk, keys, mouse or another finger to look around. */

import { isMeant } from "../keys/keys.js";
import type { Layout } from "./layout.js";

/** Metres and radians a second; an unhurried walk. */
const PACE = 1.4;
const TURN = 1.8;
const NOD = 0.9;
/** A drag across a thousand pixels turns by this much. */
const DRAG_PER_PIXEL = 0.004;
const MOST_PITCH = 0.9;

const KEYS: Record<string, [forward: number, left: number, turn: number, up: number]> = {
  KeyW: [1, 0, 0, 0],
  ArrowUp: [1, 0, 0, 0],
  KeyS: [-1, 0, 0, 0],
  ArrowDown: [-1, 0, 0, 0],
  KeyA: [0, 1, 0, 0],
  KeyD: [0, -1, 0, 0],
  KeyQ: [0, 0, 1, 0],
  ArrowLeft: [0, 0, 1, 0],
  KeyE: [0, 0, -1, 0],
  ArrowRight: [0, 0, -1, 0],
  KeyR: [0, 0, 0, 1],
  KeyF: [0, 0, 0, -1],
};

interface Drag {
  readonly id: number;
  x: number;
  y: number;
}

export class Walk {
  x = 0;
  z = 0;
  /** 0 looks along z; to the left is positive. */
  heading = 0;
  /** Of the view, upwards. */
  pitch = 0;
  private readonly held = new Set<string>();
  /** A thumb on the floor, and a finger or a mouse that looks around: both at once. */
  private thumb: Drag | undefined;
  private finger: Drag | undefined;
  private pushed = 0;

  constructor(
    canvas: HTMLElement,
    readonly layout: Layout,
  ) {
    addEventListener("keydown", (event) => {
      if (!(event.code in KEYS) || !isMeant(event)) return;
      this.held.add(event.code);
      event.preventDefault();
    });
    addEventListener("keyup", ({ code, key }) => {
      this.held.delete(code);
      if (key === "Meta") this.held.clear(); // macOS does not say when a key goes up while Command is down
    });
    addEventListener("blur", () => this.held.clear()); // no key is held for a window that nobody types into
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return; // a menu opens, and takes the mouse with it
      const drag = { id: event.pointerId, x: event.clientX, y: event.clientY };
      if (event.pointerType === "touch" && event.clientY > floorFrom(canvas)) this.thumb = drag;
      else this.finger = drag;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    for (const end of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(end, ({ pointerId }) => this.release(pointerId));
    }
  }

  /** Go on by so many seconds; who is seated turns and looks, and takes no step. */
  update(seconds: number, seated = false): void {
    let [forward, left, turn, up] = [this.pushed, 0, 0, 0];
    for (const code of this.held) {
      const [f, l, t, u] = KEYS[code]!;
      forward += f;
      left += l;
      turn += t;
      up += u;
    }
    this.heading += turn * TURN * seconds;
    this.nod(up * NOD * seconds);
    if (seated || !seconds) return;
    const length = Math.max(1, Math.hypot(forward, left));
    const step = (PACE * seconds) / length;
    const [sin, cos] = [Math.sin(this.heading), Math.cos(this.heading)];
    [this.x, this.z] = this.layout.allowed(this.x + (forward * sin + left * cos) * step, this.z + (forward * cos - left * sin) * step);
  }

  private drag({ pointerId, buttons, clientX: x, clientY: y }: PointerEvent): void {
    if (!(buttons & 1)) return this.release(pointerId); // it went up where the page was not told
    const { thumb, finger } = this;
    if (thumb?.id === pointerId) this.pushed = Math.max(-1, Math.min(1, (thumb.y - y) / 60));
    if (finger?.id !== pointerId) return;
    this.heading -= (x - finger.x) * DRAG_PER_PIXEL;
    this.nod((finger.y - y) * DRAG_PER_PIXEL);
    [finger.x, finger.y] = [x, y];
  }

  private nod(up: number): void {
    this.pitch = Math.max(-MOST_PITCH, Math.min(MOST_PITCH, this.pitch + up));
  }

  private release(id: number): void {
    if (this.thumb?.id === id) [this.thumb, this.pushed] = [undefined, 0];
    if (this.finger?.id === id) this.finger = undefined;
  }
}

/** With a finger, the lower third of what is to be seen of the picture is the floor to walk on; on a telephone the chat lies below. */
function floorFrom({ clientWidth, clientHeight }: HTMLElement): number {
  const chat = document.querySelector("aside")?.getBoundingClientRect();
  return 0.67 * (chat && chat.width > clientWidth / 2 ? chat.top : clientHeight);
}
