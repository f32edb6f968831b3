/** What the server tells, as `track/page/frames.py` writes it, and what it may be asked, as `track/page/commands.py` reads it. */

export const VERSION = 1;

export interface Hello {
  readonly type: "hello";
  readonly version: number;
  readonly shapes: readonly string[];
  readonly cameras: readonly string[];
  readonly steps: readonly string[];
  readonly settings: Settings;
  /** Whether other machines may look. */
  readonly shared?: boolean;
}

export interface Settings {
  readonly mirror?: boolean;
  readonly recording?: boolean;
  readonly calibrating?: boolean;
  readonly calibrated?: boolean;
  readonly profile?: string | null;
  readonly gains?: Readonly<Record<string, number>>;
}

export interface Step {
  readonly name: string;
  readonly state: "countdown" | "recording" | "done" | "again" | "failed" | "cancelled";
  readonly seconds_left: number;
  readonly text: string;
}

export interface Frame {
  readonly type: "frame";
  readonly number: number;
  readonly time: number | null;
  readonly weights: readonly (number | null)[] | null;
  readonly gaze: readonly (number | null)[] | null;
  /** Position in metres in glTF's frame, then yaw, pitch and roll. */
  readonly head: readonly (number | null)[] | null;
  readonly cameras: Readonly<Record<string, View>>;
  readonly fps: number | null;
  readonly latency: { readonly p50?: number | null; readonly p95?: number | null };
  readonly faults: readonly string[];
  readonly step: Step | null;
  /** The newest sentences about what was asked for, with numbers that rise. */
  readonly said?: readonly (readonly [number, string])[];
  readonly settings: Settings;
}

export interface View {
  readonly size: readonly [number, number];
  readonly points: readonly (readonly [number | null, number | null])[] | null;
}

export interface Refused {
  readonly type: "refused";
  readonly text: string;
}

export type Message = Hello | Frame | Refused;

export type Command =
  | { verb: "calibrate"; value: string }
  | { verb: "cancel" | "recentre" }
  | { verb: "mirror" | "record" | "picture"; value: boolean }
  | { verb: "gain"; shape: string; value: number }
  | { verb: "seen"; value: number };

/** `jaw_open` as people read it. */
export function words(name: string): string {
  const spaced = name.replaceAll("_", " ");
  return spaced.charAt(0).toUpperCase() + spaced.slice(1);
}
