/** A picture as a film that stands still, so that those who come later see it as well; it can be turned to another one. */

/** So many times a second it is sent. */
const STILL_HERTZ = 3;
/** Longer sides of a picture are made smaller: a wall in a page has no more pixels. */
const MOST_PIXELS = 1920;

export type Picture = ImageBitmap | HTMLCanvasElement;

export class Still {
  readonly stream: MediaStream;
  private readonly canvas = document.createElement("canvas");
  /** In memory: what sends the film reads each of its pictures, and a graphics card would have to give it back. */
  private readonly pen = this.canvas.getContext("2d", { willReadFrequently: true })!;

  constructor(private picture: Picture) {
    this.turn(picture);
    this.stream = this.canvas.captureStream(STILL_HERTZ);
    const timer = setInterval(() => {
      if (this.stream.active) return this.draw();
      clearInterval(timer);
      this.free();
    }, 1000 / STILL_HERTZ);
  }

  /** Show another one. */
  turn(picture: Picture): void {
    if (picture !== this.picture) this.free();
    this.picture = picture;
    const scale = Math.min(1, MOST_PIXELS / Math.max(picture.width, picture.height));
    // codecs want even numbers
    const [width, height] = [picture.width, picture.height].map((side) => 2 * Math.ceil((side * scale) / 2)) as [number, number];
    if (this.canvas.width !== width || this.canvas.height !== height) [this.canvas.width, this.canvas.height] = [width, height];
    this.draw();
  }

  /** A picture of a file holds tens of MB until it is closed. */
  private free(): void {
    if (!(this.picture instanceof HTMLCanvasElement)) this.picture.close();
  }

  private draw(): void {
    this.pen.drawImage(this.picture, 0, 0, this.canvas.width, this.canvas.height);
  }
}
