/**
 * Voices of the others, straight from browser to browser (WebRTC, a connection for each pair), heard from where they stand.
 *
 * Connections follow MDN's "perfect negotiation": either side may offer at any time, and the polite one gives way.
 */

import type { Candidate, Description, Person } from "./texts.js";

/** Full volume up to here, half at twice as far: a room's own law, not free air's. */
const NEAR_M = 1.2;
const ROLLOFF = 1;
/** A voice moves to a new place in this time, so that steps do not click. */
const GLIDE_S = 0.05;

interface Peer {
  readonly connection: RTCPeerConnection;
  readonly polite: boolean;
  readonly panner: PannerNode;
  readonly gain: GainNode;
  /** Chrome gives a remote voice to WebAudio only while a (muted) element plays it. */
  readonly element: HTMLAudioElement;
  readonly meter: AnalyserNode;
  readonly visit: string;
  offering: boolean;
  ignoring: boolean;
  number: number;
}

/** Metres in the room. */
export interface Place {
  x: number;
  y: number;
  z: number;
}

export type Send = (said: Description | Candidate) => void;

export class Voice {
  /** Made when the person joins: browsers play nothing before a click. */
  readonly context = new AudioContext();
  private readonly peers = new Map<string, Peer>();
  private readonly volumes = new Map<string, number>();
  private readonly muted = new Set<string>();
  private microphone: MediaStream | undefined;
  private ice: RTCIceServer[] = [];

  constructor(private readonly send: Send) {}

  /** What a new connection needs; those that are there stay as they are. */
  configure(ice: RTCIceServer[]): void {
    this.ice = ice;
  }

  /** Let the others hear this, or nothing; may change at any time. */
  speakInto(stream: MediaStream | undefined): void {
    this.microphone = stream;
    const track = stream?.getAudioTracks()[0] ?? null;
    for (const { connection } of this.peers.values()) {
      void connection.getTransceivers()[0]?.sender.replaceTrack(track);
    }
  }

  /**
   * Keep one connection to each of the others who are here. `own` is this person's id.
   *
   * Who is not on the list is let alone while their voice arrives: after a restart of the server people come back one by one.
   */
  meet(people: Iterable<Person>, own: string): void {
    const listed = new Map([...people].map((person) => [person.id, person]));
    for (const [id, { connection, visit }] of [...this.peers]) {
      const person = listed.get(id);
      const gone = person ? !person.present || person.visit !== visit : connection.connectionState !== "connected";
      if (gone) this.part(id);
    }
    for (const [id, person] of listed) {
      if (id === own || !person.present || person.replayed) continue;
      const peer = this.peers.get(id);
      if (peer) peer.number = person.number;
      else this.call(person, own < id);
      this.setMuted(id, person.muted);
    }
  }

  /** Somebody has left for good. */
  part(id: string): void {
    const peer = this.peers.get(id);
    if (!peer) return;
    this.peers.delete(id);
    peer.connection.onnegotiationneeded = peer.connection.onicecandidate = null;
    peer.connection.close();
    peer.panner.disconnect();
    peer.gain.disconnect();
    peer.element.srcObject = null;
  }

  async hear(id: string, signal: Description | Candidate): Promise<void> {
    const peer = this.peers.get(id);
    if (!peer) return;
    const { connection } = peer;
    try {
      if (signal.kind === "candidate") {
        const candidate = { candidate: signal.candidate, sdpMid: signal.mid ?? null, sdpMLineIndex: signal.line ?? null };
        await connection.addIceCandidate(candidate);
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

  /** Put a voice where a head is. */
  place(id: string, at: Place): void {
    const peer = this.peers.get(id);
    if (!peer) return;
    const until = this.context.currentTime + GLIDE_S;
    peer.panner.positionX.linearRampToValueAtTime(at.x, until);
    peer.panner.positionY.linearRampToValueAtTime(at.y, until);
    peer.panner.positionZ.linearRampToValueAtTime(at.z, until);
  }

  /** Put the ears where the own head is, turned by its heading in radians (0 looks along z, to the left is positive). */
  listen(at: Place, heading: number): void {
    const { listener, currentTime } = this.context;
    if (!listener.positionX) return; // Firefox before 2025 has only the old calls
    const until = currentTime + GLIDE_S;
    const glide = (parameter: AudioParam, value: number): void => void parameter.linearRampToValueAtTime(value, until);
    glide(listener.positionX, at.x), glide(listener.positionY, at.y), glide(listener.positionZ, at.z);
    glide(listener.forwardX, Math.sin(heading)), glide(listener.forwardZ, Math.cos(heading));
  }

  /** How loud somebody is here; 1 is as they are. */
  setVolume(id: string, volume: number): void {
    this.volumes.set(id, volume);
    this.setMuted(id, this.muted.has(id));
  }

  volume(id: string): number {
    return this.volumes.get(id) ?? 1;
  }

  /** What a moderator's mute does: nobody's page plays them. */
  private setMuted(id: string, muted: boolean): void {
    this.muted[muted ? "add" : "delete"](id);
    const gain = this.peers.get(id)?.gain;
    if (gain) gain.gain.value = muted ? 0 : this.volume(id);
  }

  /** In words, for the list of people. */
  state(id: string): "connected" | "connecting" | "failed" {
    const state = this.peers.get(id)?.connection.connectionState;
    return state === "connected" ? "connected" : state === "failed" ? "failed" : "connecting";
  }

  /** Sound of one person before it is placed, for tests: the greatest sample of the last moment. */
  peak(id: string): number {
    const meter = this.peers.get(id)?.meter;
    if (!meter) return 0;
    const samples = new Float32Array(meter.fftSize);
    meter.getFloatTimeDomainData(samples);
    return samples.reduce((most, sample) => Math.max(most, Math.abs(sample)), 0);
  }

  close(): void {
    for (const id of [...this.peers.keys()]) this.part(id);
    void this.context.close();
  }

  private call({ id, number, visit }: Pick<Person, "id" | "number" | "visit">, polite: boolean): void {
    const connection = new RTCPeerConnection({ iceServers: this.ice });
    const panner = new PannerNode(this.context, {
      panningModel: "HRTF",
      distanceModel: "inverse",
      refDistance: NEAR_M,
      rolloffFactor: ROLLOFF,
    });
    const gain = new GainNode(this.context, { gain: this.volume(id) });
    const meter = new AnalyserNode(this.context, { fftSize: 2048 });
    const element = new Audio();
    element.muted = true;
    panner.connect(gain).connect(this.context.destination);
    const peer: Peer = { connection, polite, panner, gain, element, meter, visit, offering: false, ignoring: false, number };
    this.peers.set(id, peer);

    connection.ontrack = ({ track }) => {
      const stream = new MediaStream([track]);
      element.srcObject = stream;
      void element.play().catch(() => undefined); // it is muted: only a page that is closing refuses
      const source = this.context.createMediaStreamSource(stream);
      source.connect(panner);
      source.connect(meter);
    };
    connection.onicecandidate = ({ candidate }) => {
      if (!candidate) return;
      const { sdpMid, sdpMLineIndex } = candidate;
      this.send({
        kind: "candidate",
        to: peer.number,
        candidate: candidate.candidate,
        ...(sdpMid === null ? {} : { mid: sdpMid }),
        ...(sdpMLineIndex === null ? {} : { line: sdpMLineIndex }),
      });
    };
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
    if (!polite) connection.addTransceiver(this.microphone?.getAudioTracks()[0] ?? "audio", { direction: "sendrecv" });
    else {
      connection.addEventListener("signalingstatechange", () => {
        const transceiver = connection.getTransceivers()[0];
        if (connection.signalingState !== "have-remote-offer" || !transceiver) return;
        transceiver.direction = "sendrecv";
        void transceiver.sender.replaceTrack(this.microphone?.getAudioTracks()[0] ?? null);
      });
    }
  }

  private describe({ connection, number }: Peer): void {
    const { type, sdp } = connection.localDescription!;
    if (type !== "pranswer") this.send({ kind: "description", to: number, type, sdp });
  }
}
