/**
 * Voices straight from browser to browser (WebRTC, a connection for each pair).
 *
 * Connections follow MDN's "perfect negotiation": either side may offer at any time, and the polite one gives way. After a long
 * break one side may have let go of a connection which the other still keeps: a description of another session tells.
 */

import type { Candidate, Description, Person } from "../line/texts.js";
import { begins, candidateOf, PATIENCE_MS, saidOf, sessionOf, type Lines, type Send } from "./lines.js";

interface Peer {
  readonly connection: RTCPeerConnection;
  readonly polite: boolean;
  readonly visit: string;
  offering: boolean;
  /** Whether an answer is being taken: an offer that comes meanwhile collides with none. */
  answering: boolean;
  ignoring: boolean;
  number: number;
}

export class Mesh implements Lines {
  readonly peers = new Map<string, Peer>();
  private ice: RTCIceServer[] = [];
  private track: MediaStreamTrack | null = null;
  /** Whom this page calls, whoever is the polite one: it let go of a connection that they may still keep. */
  private readonly lost = new Set<string>();

  constructor(
    private readonly send: Send,
    private readonly out: { play(id: string, track: MediaStreamTrack): void; stop(id: string): void },
  ) {}

  /** Come in, or come back: what carries a voice goes on; of all else the offers may have been lost with the line. */
  configure(ice: RTCIceServer[]): void {
    this.ice = ice;
    for (const [id, { connection }] of [...this.peers]) {
      if (connection.connectionState === "connected") continue;
      this.part(id);
      this.lost.add(id);
    }
  }

  speakInto(track: MediaStreamTrack | null): void {
    this.track = track;
    for (const { connection } of this.peers.values()) void connection.getTransceivers()[0]?.sender.replaceTrack(track);
  }

  /**
   * Keep one connection to each of the others who are here.
   *
   * Who is not on the list is let alone while their voice arrives: after a restart of the server people come back one by one.
   */
  meet(people: ReadonlyMap<string, Person>, own: string): void {
    for (const [id, { connection, visit }] of [...this.peers]) {
      const person = people.get(id);
      const anew = person !== undefined && person.visit !== visit;
      const away = person ? !person.present : connection.connectionState !== "connected";
      if (anew || away) this.part(id);
      if (away && !anew) this.lost.add(id);
    }
    for (const [id, person] of people) {
      if (id === own || !person.present || person.replayed) continue;
      const peer = this.peers.get(id);
      if (peer) peer.number = person.number;
      else this.call(person, own < id, this.lost.delete(id) || own > id);
    }
  }

  part(id: string): void {
    const peer = this.peers.get(id);
    if (!peer) return;
    this.peers.delete(id);
    peer.connection.onnegotiationneeded = peer.connection.onicecandidate = null;
    peer.connection.close();
    this.out.stop(id);
  }

  async hear(id: string, signal: Description | Candidate): Promise<void> {
    const before = this.peers.get(id);
    const peer = before && signal.kind === "description" ? this.answerer(id, before, signal) : before;
    if (!peer) return;
    const { connection } = peer;
    try {
      if (signal.kind === "candidate") {
        await connection.addIceCandidate(candidateOf(signal));
        return;
      }
      peer.answering = signal.type === "answer";
      await connection.setRemoteDescription(signal).finally(() => (peer.answering = false));
      if (signal.type === "offer") {
        await connection.setLocalDescription();
        this.describe(peer);
      }
    } catch (error) {
      // a candidate of an offer that was ignored, or a word of a connection that has ended meanwhile
      if (!peer.ignoring && connection.signalingState !== "closed") console.warn("voice:", error);
    }
  }

  state(id: string): RTCPeerConnectionState {
    return this.peers.get(id)?.connection.connectionState ?? "new";
  }

  close(): void {
    for (const id of [...this.peers.keys()]) this.part(id);
  }

  /** The connection that takes a description; none where it is of no use any more. */
  private answerer(id: string, peer: Peer, { type, sdp }: Description): Peer | undefined {
    const { connection, polite } = peer;
    const known = connection.remoteDescription?.sdp;
    const other = known !== undefined && sessionOf(sdp) !== sessionOf(known);
    const ready = !peer.offering && (connection.signalingState === "stable" || peer.answering);
    const collides = type === "offer" && !ready;
    peer.ignoring = !polite && collides;
    if (peer.ignoring) return undefined;
    if (type === "offer") return other || (collides && known === undefined) ? this.renew(id, peer, false) : peer;
    if (other) this.renew(id, peer, true); // what was offered, a connection took that knew nothing of this one
    return other ? undefined : peer;
  }

  /** Another connection in place of one that the other side does not have. */
  private renew(id: string, { number, visit, polite }: Peer, calls: boolean): Peer {
    this.part(id);
    return this.call({ id, number, visit }, polite, calls);
  }

  /** `calls` where this side makes the first offer. */
  private call({ id, number, visit }: Pick<Person, "id" | "number" | "visit">, polite: boolean, calls: boolean): Peer {
    const connection = new RTCPeerConnection({ iceServers: this.ice });
    const peer: Peer = { connection, polite, visit, offering: false, answering: false, ignoring: false, number };
    this.peers.set(id, peer);
    if (!polite) setTimeout(() => this.callAgain(id, peer), PATIENCE_MS);

    connection.ontrack = ({ track }) => this.out.play(id, track);
    connection.onicecandidate = ({ candidate }) => candidate && this.send(saidOf(candidate, peer.number));
    connection.oniceconnectionstatechange = () => {
      if (connection.iceConnectionState === "failed") connection.restartIce();
    };
    connection.onnegotiationneeded = async () => {
      try {
        peer.offering = true;
        await connection.setLocalDescription();
        this.describe(peer);
      } catch (error) {
        if (connection.signalingState !== "closed") console.warn("voice:", error);
      } finally {
        peer.offering = false;
      }
    };
    // one calls, as a rule the impolite one: both would only collide. The other answers with its microphone on the same line
    if (calls) connection.addTransceiver(this.track ?? "audio", { direction: "sendrecv" });
    else {
      connection.addEventListener("signalingstatechange", () => {
        const transceiver = connection.getTransceivers()[0];
        if (connection.signalingState !== "have-remote-offer" || !transceiver) return;
        transceiver.direction = "sendrecv";
        void transceiver.sender.replaceTrack(this.track);
      });
    }
    return peer;
  }

  /** Give up a connection that never came about; one of the two does, and the other answers. */
  private callAgain(id: string, peer: Peer): void {
    if (this.peers.get(id) === peer && begins(peer.connection)) this.renew(id, peer, true);
  }

  private describe({ connection, number }: Peer): void {
    const { type, sdp } = connection.localDescription!;
    if (type !== "pranswer") this.send({ kind: "description", to: number, type, sdp });
  }
}
