/** What the cameras see, with the landmarks drawn in. */

import type { Frame, View } from "./messages.js";

/** iBUG's 68: runs of points that are joined, and whether a run closes. A headset's traced points stand alone. */
const RUNS: readonly (readonly [number, number, boolean])[] = [
  [0, 16, false],
  [17, 21, false],
  [22, 26, false],
  [27, 30, false],
  [31, 35, false],
  [36, 41, true],
  [42, 47, true],
  [48, 59, true],
  [60, 67, true],
];

export class Cameras {
  private readonly canvases = new Map<string, HTMLCanvasElement>();
  private names: readonly string[] = [];
  private cleared = 0;
  private views: Frame["cameras"] = {};
  points = true;

  constructor(private readonly place: HTMLElement) {}

  /** One canvas a camera, as the server names them. */
  name(names: readonly string[]): void {
    this.names = names;
    this.clear();
  }

  clear(): void {
    this.cleared++;
    this.canvases.clear();
    this.place.replaceChildren();
  }

  mirror(mirrored: boolean): void {
    this.place.classList.toggle("mirrored", mirrored);
  }

  /** Remember where the points of the pictures are that come next. */
  expect(views: Frame["cameras"]): void {
    if (Object.keys(views).length) this.views = views;
  }

  async show(camera: number, jpeg: Blob): Promise<void> {
    const name = this.names[camera];
    const view = name === undefined ? undefined : this.views[name];
    if (name === undefined || !view) return;
    const { cleared } = this;
    const picture = await createImageBitmap(jpeg).catch(() => undefined);
    if (!picture) return;
    if (cleared !== this.cleared) return picture.close(); // pictures were switched off while this one was read
    const canvas = this.canvas(name);
    if (canvas.width !== picture.width || canvas.height !== picture.height) {
      [canvas.width, canvas.height] = [picture.width, picture.height];
    }
    const context = canvas.getContext("2d")!;
    context.drawImage(picture, 0, 0);
    picture.close();
    if (this.points) drawPoints(context, view, getComputedStyle(canvas).color);
  }

  private canvas(name: string): HTMLCanvasElement {
    let canvas = this.canvases.get(name);
    if (!canvas) {
      canvas = document.createElement("canvas");
      canvas.role = "img";
      canvas.ariaLabel = `Picture of ${name.replaceAll("_", " ")}`;
      this.canvases.set(name, canvas);
      this.place.append(canvas);
    }
    return canvas;
  }
}

function drawPoints(context: CanvasRenderingContext2D, { size, points }: View, colour: string): void {
  if (!points) return;
  const { width, height } = context.canvas;
  // (0, 0) is the centre of the first pixel
  const at = (index: number): [number, number] => {
    const [x, y] = points[index]!;
    return [(((x ?? NaN) + 0.5) * width) / size[0], (((y ?? NaN) + 0.5) * height) / size[1]];
  };
  const joined = points.length === 68 && points.every(([x]) => x !== null);
  // as large as a face of that size bears, on the screen
  const shown = width / (context.canvas.clientWidth || width);
  const face = joined ? Math.hypot(at(16)[0] - at(0)[0], at(16)[1] - at(0)[1]) : width / 2;
  const radius = Math.max(0.8 * shown, face / 75);
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 0.9 * radius;
  context.lineJoin = "round";
  context.globalAlpha = 0.65;
  for (const [first, last, closes] of joined ? RUNS : []) {
    context.beginPath();
    for (let index = first; index <= last; index++) context.lineTo(...at(index));
    if (closes) context.closePath();
    context.stroke();
  }
  context.globalAlpha = 1;
  for (let index = 0; index < points.length; index++) {
    context.beginPath();
    context.arc(...at(index), radius, 0, 2 * Math.PI);
    context.fill();
  }
}
