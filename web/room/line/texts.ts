/** The texts of a meeting, as `room/protocol/texts.py` and `room/protocol/answers.py` define them. */

export interface Person {
  number: number;
  id: string;
  name: string;
  avatar: string;
  /** Made anew whenever their page is loaded. */
  visit: string;
  moderator: boolean;
  present: boolean;
  voice: boolean;
  muted: boolean;
  face: "page" | "program";
  /** Whether their states go to the room's file. */
  recorded: boolean;
  /** Whether their window or picture is on the screens. */
  shares: boolean;
  /** Whether they come out of one: no page and no voice is behind them. */
  replayed: boolean;
  /** SHA-256 of an avatar that they brought; `avatar` stands in for it. */
  own: string;
}

/** One's own voice to an engine in the middle, and the others' voices from it. */
export type EngineLine = "up" | "down";

/** Which of two connections between two people a signal is for. */
export type Plane = "voice" | "screen";

export interface Description {
  kind: "description";
  plane?: Plane;
  to: number | EngineLine;
  type: "offer" | "answer" | "rollback";
  sdp: string;
}

export interface Candidate {
  kind: "candidate";
  plane?: Plane;
  to: number | EngineLine;
  candidate: string;
  mid?: string;
  line?: number;
}

export type Act = "mute" | "unmute" | "undress" | "unshare" | "remove" | "lock" | "unlock";

export type Said =
  | { kind: "join"; version: 1; key: string; secret: string; name: string; avatar: string; visit: string; role: "page"; recorded: boolean; recording: string; at_ms?: number }
  | { kind: "chat"; text: string }
  | { kind: "voice"; open: boolean }
  | Description
  | Candidate
  | { kind: "moderate"; action: Act; number?: number; id?: string }
  | { kind: "consent"; recorded: boolean }
  | { kind: "play"; paused?: boolean; time_s?: number; speed?: number }
  | { kind: "undress" }
  | { kind: "share"; on: boolean }
  | { kind: "leave" };

/** What a page asks before it comes in. */
export interface About {
  /** Id of the recording that is made; empty where there is none. A yes counts for one alone. */
  recording: string;
  replay: boolean;
  engine: boolean;
}

export interface Welcome {
  kind: "welcome";
  room: string;
  number: number;
  id: string;
  moderator: boolean;
  locked: boolean;
  hertz: number;
  shapes: string[];
  /** Id of the recording that is made; empty where there is none. A yes counts for one alone. */
  recording: string;
  replay: boolean;
  /** Whether voices go by an engine. */
  engine: boolean;
  people: Person[];
  ice: RTCIceServer[];
}

export type Answer =
  | Welcome
  | { kind: "person"; person: Person }
  | { kind: "left"; number: number }
  | { kind: "line"; number: number; name: string; moderator: boolean; text: string; time_s: number }
  | { kind: "door"; locked: boolean }
  | { kind: "playing"; time_s: number; length_s: number; paused: boolean; speed: number }
  | { kind: "signal"; sender: number | EngineLine; signal: Description | Candidate }
  | { kind: "engine"; state: "ready" | "away" }
  | { kind: "heard"; voices: Record<string, string> }
  | { kind: "notice"; text: string; about: string }
  | { kind: "refused"; text: string; again: boolean };
