/** What the ways of voices (mesh.ts, engine.ts) and of a screen (sharing.ts) have in common; voice.ts takes either of the first two. */

import type { Candidate, Description, Person } from "../line/texts.js";

export type Send = (said: Description | Candidate) => void;

/** How voices travel. Each way gives to `play` what it brings, by the person's id, and to `stop` whose voice has ended. */
export interface Lines {
  /** What a new connection needs: said on coming in, and again on coming back after a break. */
  configure(ice: RTCIceServer[]): void;
  speakInto(track: MediaStreamTrack | null): void;
  /** Who is here now; `own` is this person's id. */
  meet(people: ReadonlyMap<string, Person>, own: string): void;
  /** Somebody has left for good. */
  part(id: string): void;
  hear(sender: string, signal: Description | Candidate): Promise<void>;
  state(id: string): RTCPeerConnectionState;
  close(): void;
}

/** From a call until it is given up for another one: slow networks take half of that, and a word that was lost never comes. */
export const PATIENCE_MS = 30_000;

/** Whether a connection has not come about yet. */
export function begins({ connectionState }: RTCPeerConnection): boolean {
  return connectionState === "new" || connectionState === "connecting";
}

/** An address of this browser, as a text to somebody. */
export function saidOf({ candidate, sdpMid, sdpMLineIndex }: RTCIceCandidate, to: Candidate["to"]): Candidate {
  return {
    kind: "candidate",
    to,
    candidate,
    ...(sdpMid === null ? {} : { mid: sdpMid }),
    ...(sdpMLineIndex === null ? {} : { line: sdpMLineIndex }),
  };
}

/** What a browser takes of such a text. */
export function candidateOf({ candidate, mid, line }: Candidate): RTCIceCandidateInit {
  return { candidate, sdpMid: mid ?? null, sdpMLineIndex: line ?? null };
}

/** Which connection a description is of: of one and the same all have the session's number (RFC 8866, 5.2). */
export function sessionOf(sdp: string | undefined): string | undefined {
  return /^o=\S+ (\d+)/m.exec(sdp ?? "")?.[1];
}
