/** Moves one's own body: keys or a thumb on the floor to walk, mouse or finger to look around. */

import { isMeant } from "./keys.js";
import type { Layout } from "./layout.js";

/** Metres and radians a second; an unhurried walk. */
const PACE = 1.4;
const TURN = 1.8;
/** A drag across a thousand pixels turns by this much. */
const DRAG_PER_PIXEL = 0.004;
const MOST_PITCH = 0.9;

const KEYS: Record<string, [forward: number, left: number, turn: number]> = {
  KeyW: [1, 0, 0],
  ArrowUp: [1, 0, 0],
  KeyS: [-1, 0, 0],
  ArrowDown: [-1, 0, 0],
  KeyA: [0, 1, 0],
  KeyD: [0, -1, 0],
  KeyQ: [0, 0, 1],
  ArrowLeft: [0, 0, 1],
  KeyE: [0, 0, -1],
  ArrowRight: [0, 0, -1],
};

export class Walk {
  x = 0;
  z = 0;
  /** 0 looks along z; to the left is positive. */
  heading = 0;
  /** Of the view, upwards. */
  pitch = 0;
  private readonly held = new Set<string>();
  private drag: { id: number; x: number; y: number; walks: boolean } | undefined;
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
      const walks = event.pointerType === "touch" && event.clientY > floorFrom();
      this.drag = { id: event.pointerId, x: event.clientX, y: event.clientY, walks };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (this.drag?.id !== event.pointerId) return;
      const [dx, dy] = [event.clientX - this.drag.x, event.clientY - this.drag.y];
      if (this.drag.walks) {
        this.pushed = Math.max(-1, Math.min(1, -dy / 60));
      } else {
        this.heading -= dx * DRAG_PER_PIXEL;
        this.pitch = Math.max(-MOST_PITCH, Math.min(MOST_PITCH, this.pitch - dy * DRAG_PER_PIXEL));
        [this.drag.x, this.drag.y] = [event.clientX, event.clientY];
      }
    });
    for (const end of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(end, () => {
        this.drag = undefined;
        this.pushed = 0;
      });
    }
  }

  update(seconds: number): void {
    if (!seconds) return;
    let [forward, left, turn] = [this.pushed, 0, 0];
    for (const code of this.held) {
      const [f, l, t] = KEYS[code]!;
      forward += f;
      left += l;
      turn += t;
    }
    this.heading += turn * TURN * seconds;
    const length = Math.max(1, Math.hypot(forward, left));
    const step = (PACE * seconds) / length;
    const [sin, cos] = [Math.sin(this.heading), Math.cos(this.heading)];
    [this.x, this.z] = this.layout.allowed(this.x + (forward * sin + left * cos) * step, this.z + (forward * cos - left * sin) * step);
  }
}

/** With a finger, the lower third of what is to be seen of the picture is the floor to walk on; on a telephone the chat lies below. */
function floorFrom(): number {
  const chat = document.querySelector("aside")?.getBoundingClientRect();
  return 0.67 * (chat && chat.width > innerWidth / 2 ? chat.top : innerHeight);
}
