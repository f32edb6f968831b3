/**
 * Plays the room's sound by way of two connections within this page, where Chrome's echo cancellation sees it.
 *
 * What WebAudio plays by itself it does not see (https://crbug.com/687574): without headphones the others would hear
 * themselves. Mozilla Hubs and Element do the same. Other browsers cancel all that the machine plays, and need it not.
 */

/** Sound passes Opus once more: in stereo and at this rate nothing of the places is lost. */
const OPUS = "stereo=1;sprop-stereo=1;maxaveragebitrate=256000;usedtx=0";
/** Until the connections stand sound takes the short way, and again if they fail. */
export class Loopback {
  /** What is played; its source is the far connection. */
  readonly element = new Audio();
  private readonly near = new RTCPeerConnection();
  private readonly far = new RTCPeerConnection();
  private readonly entry: MediaStreamAudioDestinationNode;

  constructor(
    private readonly context: AudioContext,
    private readonly mix: AudioNode,
  ) {
    this.entry = new MediaStreamAudioDestinationNode(context, { channelCount: 2 });
    mix.connect(context.destination);
    this.near.onicecandidate = ({ candidate }) => void this.far.addIceCandidate(candidate ?? undefined).catch(() => undefined);
    this.far.onicecandidate = ({ candidate }) => void this.near.addIceCandidate(candidate ?? undefined).catch(() => undefined);
    this.far.ontrack = ({ track }) => {
      this.element.srcObject = new MediaStream([track]);
    };
    this.far.onconnectionstatechange = () => void this.turn();
    this.near.addTrack(this.entry.stream.getAudioTracks()[0]!, this.entry.stream);
    void this.connect();
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

  private async connect(): Promise<void> {
    try {
      await this.near.setLocalDescription();
      await this.far.setRemoteDescription(stereo(this.near.localDescription!));
      await this.far.setLocalDescription(stereo(await this.far.createAnswer()));
      await this.near.setRemoteDescription(stereo(this.far.localDescription!));
    } catch (error) {
      console.warn("voice: no loopback, so wear headphones:", error);
    }
  }

  private async turn(): Promise<void> {
    if (this.context.state === "closed") return;
    if (this.far.connectionState === "connected") {
      await this.element.play();
      this.mix.disconnect();
      this.mix.connect(this.entry);
    } else if (this.far.connectionState === "failed") {
      this.mix.disconnect();
      this.mix.connect(this.context.destination);
    }
  }
}

function stereo({ type, sdp = "" }: RTCSessionDescriptionInit): { type: RTCSdpType; sdp: string } {
  const opus = /a=rtpmap:(\d+) opus\/48000/.exec(sdp)?.[1];
  return { type, sdp: sdp.replace(new RegExp(`(a=fmtp:${opus} .*)`), `$1;${OPUS}`) };
}
