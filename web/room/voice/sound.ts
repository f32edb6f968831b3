/** One person's voice as it is heard here: from where their head is, falling with distance, as loud as it is set. */

/** Full volume up to here, half at twice as far: a room's own law, not free air's. */
const NEAR_M = 1.2;
const ROLLOFF = 1;
/** A voice moves to a new place in this time, so that steps do not click. */
const GLIDE_S = 0.05;

/** Metres in the room. */
export interface Position {
  x: number;
  y: number;
  z: number;
}

export class Sound {
  private readonly panner: PannerNode;
  private readonly gain: GainNode;
  private readonly meter: AnalyserNode;
  /** Chrome gives a remote voice to WebAudio only while a (muted) element plays it. */
  private readonly element = new Audio();
  private source: MediaStreamAudioSourceNode | undefined;
  private track: MediaStreamTrack | undefined;

  constructor(
    private readonly context: AudioContext,
    out: AudioNode,
    loudness: number,
  ) {
    this.panner = new PannerNode(context, {
      panningModel: "HRTF",
      distanceModel: "inverse",
      refDistance: NEAR_M,
      rolloffFactor: ROLLOFF,
    });
    this.gain = new GainNode(context, { gain: loudness });
    this.meter = new AnalyserNode(context, { fftSize: 2048 });
    this.element.muted = true;
    this.panner.connect(this.gain).connect(out);
  }

  /** Hear this from now on. */
  play(track: MediaStreamTrack): void {
    if (track === this.track) return;
    this.track = track;
    this.source?.disconnect();
    const stream = new MediaStream([track]);
    this.element.srcObject = stream;
    void this.element.play().catch(() => undefined); // it is muted: only a page that is closing refuses
    this.source = this.context.createMediaStreamSource(stream);
    this.source.connect(this.panner);
    this.source.connect(this.meter);
  }

  set loudness(gain: number) {
    this.gain.gain.value = gain;
  }

  /** Put the voice where a head is. */
  place(at: Position): void {
    glide(this.context, [
      [this.panner.positionX, at.x],
      [this.panner.positionY, at.y],
      [this.panner.positionZ, at.z],
    ]);
  }

  /** The greatest sample of the last moment, before the voice is placed; for tests. */
  peak(): number {
    const samples = new Float32Array(this.meter.fftSize);
    this.meter.getFloatTimeDomainData(samples);
    return samples.reduce((most, sample) => Math.max(most, Math.abs(sample)), 0);
  }

  close(): void {
    this.source?.disconnect();
    this.panner.disconnect();
    this.gain.disconnect();
    this.element.srcObject = null;
  }
}

export function glide({ currentTime }: AudioContext, moves: [AudioParam, number][]): void {
  for (const [parameter, value] of moves) parameter.linearRampToValueAtTime(value, currentTime + GLIDE_S);
}
