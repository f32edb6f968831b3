/** One's own face by the camera: pictures go to a worker of this page and nowhere else; weights, gaze and head come back. */

import type { FromWorker, ToWorker } from "./face.worker.js";
import type { OwnFace } from "./own.js";

/** A face that was not found for this long is lost: the avatar goes over to what the voice tells. */
const LOST_MS = 500;
/** A detector that takes longer than that for a picture is waited for, as many of its pictures as this; else the avatar
 * of a slow machine would go to and fro between the camera's face and the voice's. */
const WAITED_PICTURES = 3;
/** A camera that begins takes a second or two. */
const BEGINS_MS = 10_000;
/** A picture of thirty a second. */
const PICTURE_MS = 33;

export class FaceCamera {
  private readonly worker = new Worker("/static/face.worker.js", { type: "module" });
  private readonly video = document.createElement("video");
  private busy = true;
  private gone = false;
  private found: OwnFace | undefined;
  private foundAt = -Infinity;
  /** Whether the newest picture was without a face. */
  private missed = false;
  private readonly begun = performance.now();
  private fed = false;
  private said = "loading the face detector (3 MB the first time) …";
  detectMs = 0;

  private constructor(private readonly stream: MediaStream) {
    this.video.muted = true;
    this.video.playsInline = true;
    this.video.srcObject = stream;
    for (const track of stream.getVideoTracks()) {
      track.addEventListener("ended", () => {
        this.gone = true;
        this.said = "Your camera is gone; plug it in and load the page again.";
      });
    }
    this.worker.onmessage = ({ data }: MessageEvent<FromWorker>) => this.hear(data);
    this.worker.onerror = ({ message }) => (this.said = `The face detector does not start (${message}); the voice moves your lips.`);
    this.video.play().then(
      () => this.feed(),
      () => undefined, // the word says so
    );
  }

  /** What a person should know, for the page; empty while all is well. */
  get word(): string {
    const silent = !this.fed && !this.gone && performance.now() - this.begun > BEGINS_MS;
    return silent ? "Your camera gives no pictures; close what else uses it, and load the page again." : this.said;
  }

  static async ask(): Promise<FaceCamera> {
    const video = { width: { ideal: 640 }, height: { ideal: 480 }, frameRate: { ideal: 30 }, facingMode: "user" };
    return new FaceCamera(await navigator.mediaDevices.getUserMedia({ video }));
  }

  /** The newest face; undefined while none is seen. */
  face(now: number): OwnFace | undefined {
    const kept = this.missed ? LOST_MS : Math.max(LOST_MS, WAITED_PICTURES * this.detectMs);
    return now - this.foundAt < kept ? this.found : undefined;
  }

  /** The next face is how this person looks at rest. */
  neutral(): void {
    this.tell({ kind: "neutral" });
  }

  close(): void {
    this.worker.terminate();
    for (const track of this.stream.getTracks()) track.stop();
  }

  private feed(): void {
    const next = (): void => {
      if (!this.stream.active) return;
      const send = (): void => void this.send().then(next);
      if ("requestVideoFrameCallback" in this.video) this.video.requestVideoFrameCallback(send);
      else setTimeout(send, PICTURE_MS); // Firefox before 132
    };
    next();
  }

  /** The newest picture, unless the worker still has one. */
  private async send(): Promise<void> {
    this.fed = true;
    if (this.busy) return;
    this.busy = true;
    try {
      const picture = await createImageBitmap(this.video);
      this.tell({ kind: "picture", picture, time: performance.now() }, [picture]);
    } catch {
      this.busy = false; // a camera that is just changing its size
    }
  }

  private tell(message: ToWorker, moved: Transferable[] = []): void {
    this.worker.postMessage(message, moved);
  }

  private hear(message: FromWorker): void {
    this.busy = false;
    if (this.gone) return;
    switch (message.kind) {
      case "ready":
        this.said = "";
        break;
      case "failed":
        this.said = `${message.text} The voice moves your lips instead.`;
        this.busy = true;
        break;
      case "nobody":
        this.missed = true;
        this.said = performance.now() - this.foundAt < LOST_MS ? "" : "No face is seen by the camera.";
        break;
      case "face":
        this.said = message.calibrated ? "" : "Look straight ahead, relaxed, and press “This is my neutral face”.";
        this.found = { ...message, tracked: true };
        this.missed = false;
        this.foundAt = performance.now();
        this.detectMs = message.ms;
        break;
    }
  }
}
