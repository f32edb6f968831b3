/** A VRM's expressions: its own for the 52 shapes (Perfect Sync), or the presets, moved by what shows each best. */

import type { VRMExpressionManager } from "@pixiv/three-vrm";

import { finite } from "./face.js";
import { SHAPE_INDEX, shapeIndex } from "./shapes.js";

/** What moves a preset, as `regress/runtime/stages/retargeting/targets/vrm1.toml` has it, without the looks; a test holds both equal. */
export const PRESETS: Readonly<Record<string, Readonly<Record<string, number>>>> = {
  happy: { mouthSmileLeft: 0.5, mouthSmileRight: 0.5 },
  angry: { browDownLeft: 0.5, browDownRight: 0.5 },
  sad: { mouthFrownLeft: 0.5, mouthFrownRight: 0.5 },
  surprised: { browInnerUp: 0.5, eyeWideLeft: 0.25, eyeWideRight: 0.25 },
  aa: { jawOpen: 1 },
  ih: { mouthLowerDownLeft: 0.25, mouthLowerDownRight: 0.25, mouthUpperUpLeft: 0.25, mouthUpperUpRight: 0.25 },
  ou: { mouthPucker: 1 },
  ee: { mouthStretchLeft: 0.5, mouthStretchRight: 0.5 },
  oh: { mouthFunnel: 1 },
  blinkLeft: { eyeBlinkLeft: 1 },
  blinkRight: { eyeBlinkRight: 1 },
};

/** Own shapes from which on an avatar is taken to have all that its maker wanted, and presets rest. */
const OWN_ENOUGH = 10;

export class Expressions {
  /** Names of the avatar's own expressions, by shape. */
  private readonly own = new Map<number, string>();
  readonly presets: readonly string[];

  constructor(
    private readonly manager: VRMExpressionManager,
    /** Shapes that morph targets of their own carry. */
    carried: number,
  ) {
    for (const { expressionName } of manager.expressions) {
      const shape = shapeIndex(expressionName);
      if (shape !== undefined) this.own.set(shape, expressionName);
    }
    const enough = Math.max(carried, this.own.size) >= OWN_ENOUGH;
    this.presets = enough ? [] : Object.keys(PRESETS).filter((name) => manager.getExpression(name) !== null);
  }

  has(shape: number): boolean {
    return this.own.has(shape);
  }

  influence(shape: number): number | undefined {
    const name = this.own.get(shape);
    return name === undefined ? undefined : (this.manager.getValue(name) ?? undefined);
  }

  set(weights: ArrayLike<number>): void {
    for (const [shape, name] of this.own) this.manager.setValue(name, finite(weights[shape]));
    for (const preset of this.presets) {
      let value = 0;
      for (const [name, factor] of Object.entries(PRESETS[preset]!)) value += factor * finite(weights[SHAPE_INDEX.get(name)!]);
      this.manager.setValue(preset, value);
    }
  }
}
