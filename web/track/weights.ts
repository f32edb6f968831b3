/** Bars of the weights, by region of the face, with a gain for each shape. */

import { SHAPE_INDEX, SHAPES } from "../avatar/index.js";
import { Held } from "./held.js";

/** By region: rows, by what an ARKit name says behind the region's word; a star stands for Left and Right. */
const REGIONS: Readonly<Record<string, readonly string[]>> = {
  Eyes: ["eyeBlink*", "eyeWide*", "eyeSquint*", "eyeLookUp*", "eyeLookDown*", "eyeLookIn*", "eyeLookOut*"],
  Brows: ["browInnerUp", "browOuterUp*", "browDown*"],
  Jaw: ["jawOpen", "jawForward", "jaw*"],
  Mouth: [
    ...["mouthSmile*", "mouthFrown*", "mouthStretch*", "mouth*"],
    ...["mouthFunnel", "mouthPucker", "mouthClose", "tongueOut"],
  ],
  Lips: [
    ...["mouthUpperUp*", "mouthLowerDown*", "mouthPress*", "mouthDimple*"],
    ...["mouthRollUpper", "mouthRollLower", "mouthShrugUpper", "mouthShrugLower"],
  ],
  "Cheeks, nose": ["cheekPuff", "cheekSquint*", "noseSneer*"],
};
const LARGEST_GAIN = 3;
/** Numbers that change faster cannot be read, and screen readers need a calmer pace still. */
const NUMBERS_MS = 120;
const SPOKEN_MS = 1000;
/** While somebody moves a slider, what the server says of it is older. */
const HELD_MS = 800;

type SetGain = (shape: string, gain: number) => void;

function make<K extends keyof HTMLElementTagNameMap>(tag: K, className = "", text = ""): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  if (className) element.className = className;
  if (text) element.textContent = text;
  return element;
}

/** `mouthUpperUp*` as people read it beside the heading of its region. */
function title(row: string): string {
  const own = row.replace("*", "").replace(/^(eye|brow|mouth|jaw)(?=[A-Z])/, "");
  const spaced = own.replace(/([a-z])([A-Z])/g, "$1 $2").toLowerCase();
  return row === "jaw*" || row === "mouth*" ? "sideways" : spaced;
}

/** One shape's bar, number and slider. */
class Bar {
  readonly cell = make("div", "bar");
  private readonly meter = make("div", "meter");
  private readonly fill = make("div", "fill");
  private readonly number = make("span", "number", "–");
  private readonly slider = make("input", "gain");
  private readonly factor = make("span", "number factor", "×1");
  private readonly held = new Held(HELD_MS);

  constructor(
    shape: string,
    private readonly setGain: SetGain,
  ) {
    this.meter.role = "meter";
    this.meter.ariaLabel = shape;
    this.meter.ariaValueNow = this.meter.ariaValueMin = "0";
    this.meter.ariaValueMax = "1";
    this.meter.append(this.fill);
    Object.assign(this.slider, { type: "range", min: "0", max: `${LARGEST_GAIN}`, step: "0.05", value: "1" });
    this.slider.ariaLabel = `Gain of ${shape}`;
    this.slider.addEventListener("input", () => this.ask());
    this.cell.dataset["shape"] = shape;
    this.cell.append(this.meter, this.number, this.slider, this.factor);
  }

  show(weight: number, numbers: boolean, spoken: boolean): void {
    const known = Number.isFinite(weight);
    this.fill.style.transform = `scaleX(${known ? Math.min(Math.max(weight, 0), 1) : 0})`;
    if (numbers) {
      this.number.textContent = known ? weight.toFixed(2) : "–";
      this.number.classList.toggle("resting", !(weight >= 0.005));
    }
    if (spoken) this.meter.ariaValueNow = known ? weight.toFixed(2) : "0";
  }

  showGain(gain: number): void {
    if (this.held.on || this.slider.valueAsNumber === gain) return;
    this.slider.value = `${gain}`;
    this.write(gain);
  }

  resetGain(): void {
    if (this.slider.valueAsNumber === 1) return;
    this.slider.value = "1";
    this.ask();
  }

  private ask(): void {
    this.held.hold();
    this.write(this.slider.valueAsNumber);
    this.setGain(this.cell.dataset["shape"]!, this.slider.valueAsNumber);
  }

  private write(gain: number): void {
    this.factor.textContent = `×${Number(gain.toFixed(2))}`;
    this.cell.classList.toggle("changed", gain !== 1);
  }
}

export class Weights {
  private readonly bars: readonly Bar[];
  private numbersAt = 0;
  private spokenAt = 0;

  constructor(place: HTMLElement, setGain: SetGain) {
    const bars: Bar[] = SHAPES.map((shape) => new Bar(shape, setGain));
    for (const [region, rows] of Object.entries(REGIONS)) {
      const section = make("section", "region");
      section.append(make("h3", "", region));
      for (const row of rows) {
        const shapes = row.endsWith("*") ? ["Left", "Right"].map((side) => row.replace("*", side)) : [row];
        const line = make("div", shapes.length === 1 ? "row single" : "row");
        line.append(make("span", "name", title(row)), ...shapes.map((shape) => bars[SHAPE_INDEX.get(shape)!]!.cell));
        section.append(line);
      }
      place.append(section);
    }
    this.bars = bars;
  }

  show(weights: ArrayLike<number>): void {
    const now = performance.now();
    const numbers = now - this.numbersAt > NUMBERS_MS;
    const spoken = now - this.spokenAt > SPOKEN_MS;
    if (numbers) this.numbersAt = now;
    if (spoken) this.spokenAt = now;
    this.bars.forEach((bar, shape) => bar.show(weights[shape]!, numbers, spoken));
  }

  showGains(gains: Readonly<Record<string, number>>): void {
    this.bars.forEach((bar, shape) => bar.showGain(gains[SHAPES[shape]!] ?? 1));
  }

  resetGains(): void {
    for (const bar of this.bars) bar.resetGain();
  }
}
