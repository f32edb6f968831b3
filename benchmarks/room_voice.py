"""Measures voices: browsers with fake microphones in one room, straight from each to each, or by Janus.

    python benchmarks/room_voice.py --mesh 2,3,4 --janus 2,3,4,5,6 --seconds 20

Each person is a headless Chromium of its own on this machine, which draws nothing, and repeats three seconds of sound:
a burst like a voice, and silence. Counted are the processor time of each browser's processes, what its connections sent
and received (RTP and what goes with it, without IP's own headers), and each burst from a meter at the speaker's
microphone to one of the same kind at the listener's. Medians over people, pairs and bursts. Needs Chromium, and Janus
for its rows.
Last result: see docs/measurements/room.md, with machine, versions and date.
"""

import argparse
import asyncio
import statistics
import sys
import tempfile
import time
from contextlib import AsyncExitStack
from dataclasses import dataclass
from pathlib import Path

import psutil

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from room.server.janus import Janus  # noqa: E402
from tests.browser import Tab, chromium  # noqa: E402
from tests.room.engines import API_SECRET, free_port, janus  # noqa: E402
from tests.room.guests import open_room  # noqa: E402
from tests.room.page import AWAKE, come_in  # noqa: E402
from tests.room.speech import SILENT_S, VOICED_S, write_bursts  # noqa: E402

MOST_WAIT_S = 60.0
"""For all lines between people, after the last one came in; what is not there then is told as not heard."""

SETTLE_S = 5.0
"""From the last line that stands to what counts: receivers kept more in hand while pages were loaded."""

EARLIEST_S = -0.1
"""A speaker's page that stood still for a moment notes its own burst later than others hear it."""

LATEST_S = 1.5
"""A burst that begins later at the listener is taken for the next one, and this one for lost."""

NAMES = ("Ada", "Ben", "Cy", "Dan", "Eva", "Fay", "Gil", "Hal")

STILL = "void meeting.stage.view.renderer.setAnimationLoop(null)"
"""Asks for no more pictures: also undrawn ones cost software a part of a core."""

WATCH = """void (() => {
  globalThis.bursts = { '': [] };
  const { context } = meeting.voice;
  const meter = new AnalyserNode(context, { fftSize: 2048 });
  context.createMediaStreamSource(meeting.microphone.stream).connect(meter);
  const samples = new Float32Array(meter.fftSize);
  const own = () => {
    meter.getFloatTimeDomainData(samples);
    return samples.reduce((most, sample) => Math.max(most, Math.abs(sample)), 0);
  };
  const loud = {};
  const note = (id, level) => {
    const now = level > 0.01;
    if (now && !loud[id]) (bursts[id] ??= []).push(Date.now());
    // a burst has syllables: only a longer silence ends it
    loud[id] = now ? Date.now() : loud[id] && Date.now() - loud[id] < 600 ? loud[id] : 0;
  };
  setInterval(() => {
    note('', own());
    for (const [id, sound] of meeting.voice.sounds) note(id, sound.peak());
  }, 10);
})()"""
"""Notes when sound begins at the own microphone and from each of the others, every ten milliseconds, by like meters."""

CONNECTED = "[...meeting.voice.sounds.keys()].filter((id) => meeting.voice.state(id) === 'connected').length"

BYTES = """(async () => {
  const { lines } = meeting.voice;
  const lanes = lines.peers ? [...lines.peers.values()].map(({ connection }) => connection) : [lines.up, lines.down];
  const sums = [0, 0];
  for (const lane of lanes.filter(Boolean)) {
    for (const { type, bytesSent, bytesReceived } of (await lane.getStats()).values()) {
      if (type === 'transport') { sums[0] += bytesSent; sums[1] += bytesReceived; }
    }
  }
  return sums;
})()"""


@dataclass(frozen=True, kw_only=True)
class Measured:
    """One call.

    Parameters
    ----------
    people
        In it.
    processor
        Share of a core that a person's browser took, the median of all.
    engine
        The same of Janus; None where there is none.
    up_kbit_s, down_kbit_s
        Of a person's voices.
    later_ms
        From a burst at the speaker's meter to the listener's.
    heard, bursts
        Of the bursts that each pair had, those that came through.
    lines, pairs
        Of the pairs of a speaker and a listener, those whose line stood.
    """

    people: int
    processor: float
    engine: float | None
    up_kbit_s: float
    down_kbit_s: float
    later_ms: tuple[float, ...]
    heard: int
    bursts: int
    lines: int
    pairs: int


def browsers() -> list[psutil.Process]:
    """Chromiums that this program started."""
    return [each for each in psutil.Process().children() if "chrom" in each.name()]


def taken_s(process: psutil.Process) -> float:
    """Processor time of a process and those that it started."""
    total = 0.0
    for each in (process, *process.children(recursive=True)):
        try:
            times = each.cpu_times()
        except psutil.NoSuchProcess:
            continue
        total += times.user + times.system
    return total


async def hold(people: int, *, by_janus: bool, seconds: float, folder: Path) -> Measured:
    """Let so many people talk to each other."""
    async with AsyncExitStack() as stack:
        engine, engines = None, []
        if by_janus:
            port = free_port()
            engine = psutil.Process(stack.enter_context(janus(port, folder)).pid)
            engines = [Janus(f"ws://127.0.0.1:{port}", secret=API_SECRET)]
        place = await stack.enter_async_context(open_room(engines=engines))
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        sound = f"--use-file-for-fake-audio-capture={folder / 'speech.wav'}"
        tabs: list[Tab] = []
        for name in NAMES[:people]:
            browser = await stack.enter_async_context(chromium(*AWAKE, sound))
            tabs.append(await stack.enter_async_context(browser.open(link)))
            await tabs[-1].look(width=480, height=360)
            await come_in(tabs[-1], name)
            await tabs[-1].ask(STILL)
            await tabs[-1].ask(WATCH)
        end = time.monotonic() + MOST_WAIT_S
        while time.monotonic() < end and await lines(tabs) < people * (people - 1):
            await asyncio.sleep(0.5)
        await asyncio.sleep(SETTLE_S)
        before = [taken_s(each) for each in (*browsers(), *([engine] if engine else []))]
        carried = [await tab.ask(BYTES) for tab in tabs]
        begun, begun_ms = time.monotonic(), await tabs[0].ask("Date.now()")
        await asyncio.sleep(seconds)
        took = time.monotonic() - begun
        after = [taken_s(each) for each in (*browsers(), *([engine] if engine else []))]
        sent = [await tab.ask(BYTES) for tab in tabs]
        shares = [(late - early) / took for early, late in zip(before, after, strict=True)]
        ids = [await tab.ask("meeting.own.id") for tab in tabs]
        bursts = [await tab.ask("bursts") for tab in tabs]
        stood = await lines(tabs)
    later, count = [], 0
    for speaker, own in enumerate(bursts):
        spoken = [at for at in own[""] if begun_ms <= at < begun_ms + 1000 * (seconds - LATEST_S)]
        for listener, heard in enumerate(bursts):
            if listener != speaker:
                count += len(spoken)
                later += delays_ms(spoken, heard.get(ids[speaker], []))
    up, down = zip(
        *(
            [(b - a) * 8 / 1000 / took for a, b in zip(*pair, strict=True)]
            for pair in zip(carried, sent, strict=True)
        ),
        strict=True,
    )
    return Measured(
        people=people,
        processor=statistics.median(shares[:people]),
        engine=shares[people] if engine else None,
        up_kbit_s=statistics.median(up),
        down_kbit_s=statistics.median(down),
        later_ms=tuple(later),
        heard=len(later),
        bursts=count,
        lines=stood,
        pairs=people * (people - 1),
    )


async def lines(tabs: list[Tab]) -> int:
    """Pairs of a speaker and a listener whose line stands."""
    return sum([await tab.ask(CONNECTED) for tab in tabs])


def delays_ms(spoken: list[int], heard: list[int]) -> list[float]:
    """Of each burst that came through, how much later it began at the listener."""
    found = ([at - begun for at in heard if EARLIEST_S <= (at - begun) / 1000 < LATEST_S] for begun in spoken)
    return [min(each) for each in found if each]


def row(way: str, measured: Measured) -> str:
    """One line of the table."""
    if measured.later_ms:
        half, most = (
            statistics.median(measured.later_ms),
            sorted(measured.later_ms)[int(0.95 * measured.heard)],
        )
        later = f"{half:.0f}, {most:.0f}"
    else:
        later = "-"
    return (
        f"| {way}, {measured.people} | {measured.processor:.0%} | "
        f"{'-' if measured.engine is None else f'{measured.engine:.1%}'} | "
        f"{measured.up_kbit_s:.0f}, {measured.down_kbit_s:.0f} | {later} | "
        f"{measured.heard} of {measured.bursts} | {measured.lines} of {measured.pairs} |"
    )


def main() -> None:
    """Hold the calls one after the other, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    for way, people in (("mesh", "2,3,4"), ("janus", "2,3,4,5,6")):
        parser.add_argument(f"--{way}", default=people, help=f"how many people, {people} by default; none: -")
    parser.add_argument("--seconds", type=float, default=20.0, help="of each call, from when all lines stand")
    options = parser.parse_args()
    if options.seconds < 2 * (VOICED_S + SILENT_S):
        parser.error("--seconds: two bursts take six seconds")
    print("| voices, people | processor of a browser, of a core | of Janus | kbit/s up, down | ms, half and 95 % "
          "| bursts heard | lines |\n|---|---|---|---|---|---|---|")  # fmt: skip
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        write_bursts(folder / "speech.wav")
        for way in ("mesh", "janus"):
            for people in getattr(options, way).replace("-", "").split(","):
                if people:
                    call = hold(int(people), by_janus=way == "janus", seconds=options.seconds, folder=folder)
                    print(row(way, asyncio.run(call)), flush=True)


if __name__ == "__main__":
    main()
