/** The 52 ARKit shapes, in facegen's order, and how they are found behind others' spellings. */

const BOTH = (...names: string[]): string[] => names.flatMap((name) => [`${name}Left`, `${name}Right`]);
const EYE = ["Blink", "LookDown", "LookIn", "LookOut", "LookUp", "Squint", "Wide"];

/** As `facegen.conventions.BLENDSHAPES`; a test holds the two equal. */
export const SHAPES: readonly string[] = [
  ...EYE.map((name) => `eye${name}Left`),
  ...EYE.map((name) => `eye${name}Right`),
  ...["jawForward", "jawLeft", "jawRight", "jawOpen"],
  ...["mouthClose", "mouthFunnel", "mouthPucker", "mouthLeft", "mouthRight"],
  ...BOTH("mouthSmile", "mouthFrown", "mouthDimple", "mouthStretch"),
  ...["mouthRollLower", "mouthRollUpper", "mouthShrugLower", "mouthShrugUpper"],
  ...BOTH("mouthPress", "mouthLowerDown", "mouthUpperUp"),
  ...BOTH("browDown"),
  "browInnerUp",
  ...BOTH("browOuterUp"),
  "cheekPuff",
  ...BOTH("cheekSquint", "noseSneer"),
  "tongueOut",
];

/** Eye rotations at which an eyeLook weight reaches 1, as in `regress.runtime.stages.gaze`. */
export const FULL_YAW_RAD = (30 * Math.PI) / 180;
export const FULL_PITCH_RAD = (25 * Math.PI) / 180;

export const SHAPE_INDEX: ReadonlyMap<string, number> = new Map(SHAPES.map((name, index) => [name, index]));

/** Letters alone, in lower case, with a lone L or R at the end in full. */
function key(spelling: string): string {
  return spelling
    .replace(/[_\-. ]+(l|r)$/i, (_, side: string) => (side.toLowerCase() === "l" ? "left" : "right"))
    .replace(/[^a-z]/gi, "")
    .toLowerCase();
}

const BY_KEY = new Map(SHAPES.map((name, index) => [key(name), index]));

/**
 * Index of the shape that a morph target or an expression is called after, or undefined.
 *
 * `jawOpen`, `JawOpen` (Perfect Sync), `jaw_open`, `eyeBlink_L`, `eyeBlink-Left` and `blendShape1.eyeBlink_L` (Maya) are known;
 * a name of which an ARKit name is only a part, such as `jawOpenWide`, is another shape.
 */
export function shapeIndex(spelling: string): number | undefined {
  const whole = BY_KEY.get(key(spelling));
  return whole ?? BY_KEY.get(key(spelling.slice(spelling.lastIndexOf(".") + 1)));
}
