/** Shows a film on a screen of the room: as large as it fits, its sides as they are. */

import { LinearFilter, Mesh, MeshBasicMaterial, PlaneGeometry, SRGBColorSpace, Vector3, VideoTexture } from "three";

/** Before the screen, in metres: nearer would flicker. */
const BEFORE = 0.004;

export class Board {
  private readonly film = document.createElement("video");
  private readonly picture: MeshBasicMaterial;
  private readonly planes: { plane: Mesh; width: number; height: number }[] = [];

  constructor(screens: readonly Mesh[]) {
    Object.assign(this.film, { muted: true, playsInline: true, autoplay: true });
    const texture = new VideoTexture(this.film);
    texture.colorSpace = SRGBColorSpace;
    texture.minFilter = LinearFilter;
    this.picture = new MeshBasicMaterial({ map: texture, toneMapped: false });
    for (const screen of screens) {
      screen.geometry.computeBoundingBox();
      const size = screen.geometry.boundingBox!.getSize(new Vector3());
      const middle = screen.geometry.boundingBox!.getCenter(new Vector3());
      const plane = new Mesh(new PlaneGeometry(1, 1), this.picture);
      plane.position.set(middle.x, middle.y, screen.geometry.boundingBox!.max.z + BEFORE);
      plane.visible = false;
      screen.add(plane);
      this.planes.push({ plane, width: size.x, height: size.y });
    }
    this.film.addEventListener("resize", () => this.fit());
  }

  /** Whether a picture has come; for tests as well. */
  get shown(): boolean {
    return this.film.srcObject !== null && this.film.videoWidth > 0;
  }

  get size(): [number, number] {
    return [this.film.videoWidth, this.film.videoHeight];
  }

  show(stream: MediaStream | undefined): void {
    this.film.srcObject = stream ?? null;
    if (stream) void this.film.play().catch(() => undefined); // it is muted: only a page that is closing refuses
    this.fit();
  }

  private fit(): void {
    const { videoWidth, videoHeight } = this.film;
    for (const { plane, width, height } of this.planes) {
      plane.visible = this.shown;
      if (!this.shown) continue;
      const scale = Math.min(width / videoWidth, height / videoHeight);
      plane.scale.set(videoWidth * scale, videoHeight * scale, 1);
    }
  }
}
