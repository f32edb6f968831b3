"""The room's page as people use it: coming in, speaking, listening, seen from two tabs of one real browser."""

import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from tests.browser import Tab, chromium
from tests.room.bare_place import BARE
from tests.room.guests import Place, open_room
from tests.room.speech import write_bursts

AWAKE = (
    *("--disable-background-timer-throttling", "--disable-backgrounding-occluded-windows"),
    *("--disable-renderer-backgrounding", "--autoplay-policy=no-user-gesture-required", "--mute-audio"),
    *("--use-fake-ui-for-media-stream", "--use-fake-device-for-media-stream"),
)
"""Two pages of one browser: neither is slowed because the other is in front."""


@asynccontextmanager
async def meet(tmp_path: Path, *names: str) -> AsyncIterator[tuple[Place, list[Tab]]]:
    """A server, a browser, and people who have come in by the page."""
    write_bursts(tmp_path / "speech.wav")
    async with open_room(places=BARE) as place:
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        async with chromium(
            *AWAKE, f"--use-file-for-fake-audio-capture={tmp_path / 'speech.wav'}"
        ) as browser:
            opened = [browser.open(link) for _ in names]
            tabs = [await tab.__aenter__() for tab in opened]
            try:
                for tab, name in zip(tabs, names, strict=True):
                    await tab.look(width=480, height=360)
                    await come_in(tab, name)
                for tab in tabs:
                    await tab.until(f"meeting.known.size === {len(names)}")
                yield place, tabs
            finally:
                for tab in opened:
                    await tab.__aexit__(None, None, None)


UNDRAWN = """void Object.defineProperty(globalThis, 'meeting', {
  configurable: true,
  get: () => globalThis.undrawn,
  set: (meeting) => {
    globalThis.undrawn = meeting;
    meeting.stage.drawing = false;
  },
})"""
"""No picture of the meeting is drawn, not even a first one: in software its shaders alone take seconds."""


async def come_in(tab: Tab, name: str) -> None:
    """By the page, which draws nothing until it is told to."""
    await tab.until("document.querySelector('#join select[name=avatar]')?.value")
    await tab.ask(UNDRAWN)
    await tab.ask(
        f"(() => {{ const form = document.querySelector('#join'); form.elements.name.value = {json.dumps(name)};"
        " form.requestSubmit(); })()"
    )
    await tab.until("globalThis.meeting?.own")


def other(name: str) -> str:
    """Somebody as another's page knows them."""
    return f"[...meeting.known.values()].find(({{ person }}) => person.name === {json.dumps(name)})"


FACE = """void (meeting.presence.idle.update = () => ({
  weights: Float32Array.from(%s), gaze: [0.1, 0.05, 0.1, 0.05], head: [0.2, 0.1, 0], head_m: [0, 0, 0], tracked: true,
}))"""
"""Lets a page send a face, as a camera would."""


CONNECTED = "[...meeting.voice.sounds.keys()].some((id) => meeting.voice.state(id) === 'connected')"


EARS = """void (globalThis.listen = async () => {
  const { context, loopback } = meeting.voice;
  const split = new ChannelSplitterNode(context, { numberOfOutputs: 2 });
  context.createMediaStreamSource(loopback.element.srcObject).connect(split);
  const meters = [0, 1].map((ear) => new AnalyserNode(context, { fftSize: 4096 }));
  meters.forEach((meter, ear) => split.connect(meter, ear));
  const sums = [0, 0];
  const samples = new Float32Array(4096);
  while (Math.max(...sums) < 100) {
    await new Promise((resolve) => setTimeout(resolve, 100));
    meters.forEach((meter, ear) => {
      meter.getFloatTimeDomainData(samples);
      sums[ear] += samples.reduce((sum, sample) => sum + sample * sample, 0);
    });
  }
  return sums;
})"""
"""Energy at the left and the right ear, of what the page plays behind its loopback, once there was speech."""


HEARD = """void (() => {
  globalThis.heard = [];
  let loud = false, quiet = 0, since = 0;
  const { microphone } = meeting;
  const hear = microphone.hear;
  microphone.hear = (frame) => {
    hear.call(microphone, frame);
    if (microphone.level > 0.01) {
      if (!loud) heard.push([(loud = true), Date.now()]);
      quiet = 0;
      return;
    }
    if (!quiet++) since = Date.now();
    if (loud && quiet === 15) heard.push([(loud = false), since]);
  };
})()"""
"""When the sound at a microphone begins and ends; a gap of less than .3 s is a busy machine's, and no end."""


SHOWN = """void (() => {
  globalThis.shown = [];
  const { figure } = %s;
  const speak = figure.speak;
  figure.speak = (speaking) => {
    if (speaking !== figure.signShown) shown.push([speaking, Date.now()]);
    speak.call(figure, speaking);
  };
})()"""
"""When somebody's sign comes and goes."""


def hears_from(own: float, others: float) -> str:
    """Whether a page has its ears at this x, and the voices of others at that one."""
    return (
        f"Math.abs(meeting.voice.context.listener.positionX.value - {own}) < 0.02 && "
        "[...meeting.voice.sounds.values()]"
        f".every(({{ panner }}) => Math.abs(panner.positionX.value - {others}) < 0.02)"
    )


LINGERS_S = 0.3
"""What was played where a voice stood before has left the meters of `EARS` after 0.1."""
