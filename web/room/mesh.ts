/**
 * Voices straight from browser to browser (WebRTC, a connection for each pair).
 *
 * Connections follow MDN's "perfect negotiation": either side may offer at any time, and the polite one gives way.
 */

import { candidateOf, saidOf, type Lines, type Send } from "./lines.js";
import type { Candidate, Description, Person } from "./texts.js";

interface Peer {
  readonly connection: RTCPeerConnection;
  readonly polite: boolean;
  readonly visit: string;
  offering: boolean;
  ignoring: boolean;
  number: number;
}

export class Mesh implements Lines {
  readonly peers = new Map<string, Peer>();
  /** What a new connection needs; those that are there stay as they are. */
  ice: RTCIceServer[] = [];
  private track: MediaStreamTrack | null = null;

  constructor(
    private readonly send: Send,
    private readonly out: { play(id: string, track: MediaStreamTrack): void; stop(id: string): void },
  ) {}

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
      const gone = person ? !person.present || person.visit !== visit : connection.connectionState !== "connected";
      if (gone) this.part(id);
    }
    for (const [id, person] of people) {
      if (id === own || !person.present || person.replayed) continue;
      const peer = this.peers.get(id);
      if (peer) peer.number = person.number;
      else this.call(person, own < id);
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
    const peer = this.peers.get(id);
    if (!peer) return;
    const { connection } = peer;
    try {
      if (signal.kind === "candidate") {
        await connection.addIceCandidate(candidateOf(signal));
        return;
      }
      const collides = signal.type === "offer" && (peer.offering || connection.signalingState !== "stable");
      peer.ignoring = !peer.polite && collides;
      if (peer.ignoring) return;
      await connection.setRemoteDescription(signal);
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

  private call({ id, number, visit }: Pick<Person, "id" | "number" | "visit">, polite: boolean): void {
    const connection = new RTCPeerConnection({ iceServers: this.ice });
    const peer: Peer = { connection, polite, visit, offering: false, ignoring: false, number };
    this.peers.set(id, peer);

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
    // the impolite one calls: both would only collide. The other answers with its own microphone on the same line
    if (!polite) connection.addTransceiver(this.track ?? "audio", { direction: "sendrecv" });
    else {
      connection.addEventListener("signalingstatechange", () => {
        const transceiver = connection.getTransceivers()[0];
        if (connection.signalingState !== "have-remote-offer" || !transceiver) return;
        transceiver.direction = "sendrecv";
        void transceiver.sender.replaceTrack(this.track);
      });
    }
  }

  private describe({ connection, number }: Peer): void {
    const { type, sdp } = connection.localDescription!;
    if (type !== "pranswer") this.send({ kind: "description", to: number, type, sdp });
  }
}
