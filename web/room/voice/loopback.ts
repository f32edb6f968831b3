/**
 * Plays the room's sound by way of two connections within this page, where Chrome's echo cancellation sees it.
 *
 * What WebAudio plays by itself it does not see (https://crbug.com/687574): without headphones the others would hear
 * themselves. Mozilla Hubs and Element do the same. Other browsers cancel all that the machine plays, and need it not.
 */

/** Sound passes Opus once more: in stereo and at this rate nothing of the places is lost. */
const OPUS = "stereo=1;sprop-stereo=1;maxaveragebitrate=256000;usedtx=0";
/** From a pair that failed to the next one: without any network each fails at once. */
const AGAIN_MS = 2000;

/** Until the connections stand, and while they are cut, as by a change of networks, sound takes the short way. */
export class Loopback {
  /** What is played; its source is the far connection. */
  readonly element = new Audio();
  private near!: RTCPeerConnection;
  private far!: RTCPeerConnection;
  private readonly entry: MediaStreamAudioDestinationNode;

  constructor(
    private readonly context: AudioContext,
    private readonly mix: AudioNode,
  ) {
    this.entry = new MediaStreamAudioDestinationNode(context, { channelCount: 2 });
    mix.connect(context.destination);
    this.begin();
  }

  /** Whether sound goes this way now. */
  get used(): boolean {
    return this.far.connectionState === "connected" && !this.element.paused;
  }

  close(): void {
    this.near.close();
    this.far.close();
    this.element.srcObject = null;
  }

  private begin(): void {
    if (this.context.state === "closed") return;
    const [near, far] = ([this.near, this.far] = [new RTCPeerConnection(), new RTCPeerConnection()]);
    near.onicecandidate = ({ candidate }) => void far.addIceCandidate(candidate ?? undefined).catch(() => undefined);
    far.onicecandidate = ({ candidate }) => void near.addIceCandidate(candidate ?? undefined).catch(() => undefined);
    far.ontrack = ({ track }) => {
      this.element.srcObject = new MediaStream([track]);
    };
    far.onconnectionstatechange = () => far === this.far && void this.turn();
    near.addTrack(this.entry.stream.getAudioTracks()[0]!, this.entry.stream);
    void connect(near, far).catch((error: unknown) => {
      if (this.context.state !== "closed") console.warn("voice: no loopback, so wear headphones:", error);
    });
  }

  private async turn(): Promise<void> {
    const { far } = this;
    if (this.context.state === "closed") return;
    if (far.connectionState === "connected") {
      const plays = await this.element.play().then(
        () => true,
        () => false, // the short way stays
      );
      if (plays && far === this.far && far.connectionState === "connected") this.lead(this.entry);
    } else if (far.connectionState === "disconnected") {
      this.lead(this.context.destination);
    } else if (far.connectionState === "failed") {
      this.lead(this.context.destination);
      this.close();
      setTimeout(() => this.begin(), AGAIN_MS); // the addresses of these may be of a network that is gone
    }
  }

  private lead(way: AudioNode): void {
    this.mix.disconnect();
    this.mix.connect(way);
  }
}

async function connect(near: RTCPeerConnection, far: RTCPeerConnection): Promise<void> {
  await near.setLocalDescription();
  await far.setRemoteDescription(stereo(near.localDescription!));
  await far.setLocalDescription(stereo(await far.createAnswer()));
  await near.setRemoteDescription(stereo(far.localDescription!));
}

function stereo({ type, sdp = "" }: RTCSessionDescriptionInit): { type: RTCSdpType; sdp: string } {
  const opus = /a=rtpmap:(\d+) opus\/48000/.exec(sdp)?.[1];
  return { type, sdp: sdp.replace(new RegExp(`(a=fmtp:${opus} .*)`), `$1;${OPUS}`) };
}
