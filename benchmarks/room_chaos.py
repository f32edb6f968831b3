"""Measures what two people in pages notice when a part of their room is killed and started again.

    python benchmarks/room_chaos.py --times 3

Ada and Ben are two tabs of one headless Chromium that draws nothing. What Ben's page gets of Ada is watched: each state
that comes, thirty a second, and each packet of her voice. Then something is killed with SIGKILL:

- `server`: `room serve`, by which both came. Voices go straight.
- `redis`: Redis, over which Ada's server and Ben's server carry one room. Voices go straight.
- `janus`: Janus, by which all voices go.
- `browser`: the browser of a third person, beside them.

After --away seconds it is started again (the browser is not). Pauses are the longest time without a state, and without
a packet; `nothing` has those of a room in which nothing is killed. Times until back count from the moment at which the
new process listens: until Ada's next state, and the next packet of her voice.
Last result: see docs/measurements/room.md, with machine, versions and date. Needs Chromium, redis-server and Janus.
"""

import argparse
import asyncio
import itertools
import os
import sys
import tempfile
from collections.abc import Callable
from contextlib import AsyncExitStack, ExitStack
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from room.server import load_keys  # noqa: E402
from tests.browser import Tab, chromium  # noqa: E402
from tests.room.engines import API_SECRET, free_port, janus, redis  # noqa: E402
from tests.room.page import AWAKE, CONNECTED, come_in, other  # noqa: E402
from tests.room.speech import write_bursts  # noqa: E402
from tests.room.test_chaos import server  # noqa: E402

STANDS = {"x": 2.5, "z": -1.5}
SETTLE_S = 5.0
"""From the first word between two people to the kill: first seconds of pages are uneven."""

AFTER_S = 8.0
"""From the new process on, in which everything comes back."""

WATCH = """void (() => {
  globalThis.watched = { states: [], packets: [] };
  const { handlers } = meeting.line;
  const { state } = handlers;
  handlers.state = (number, message) => {
    state(number, message);
    if (meeting.known.get(number)?.person.name === 'Ada') watched.states.push([Date.now(), ...message.floor_m]);
  };
  let last = 0, busy = false;
  setInterval(async () => {
    if (busy) return;
    busy = true;
    const { lines } = meeting.voice;
    const lanes = lines?.peers ? [...lines.peers.values()].map(({ connection }) => connection) : [lines?.down];
    let count = 0;
    for (const lane of lanes.filter(Boolean)) {
      for (const { type, kind, packetsReceived } of (await lane.getStats()).values()) {
        if (type === 'inbound-rtp' && kind === 'audio') count += packetsReceived;
      }
    }
    // a new connection counts from 0 again
    if (count && count !== last) watched.packets.push(Date.now());
    last = count;
    busy = false;
  }, 20);
})()"""
"""Notes each state of Ada's, and each time at which more of her voice has come."""


@dataclass(frozen=True, kw_only=True)
class Noticed:
    """What Ben's page noticed, in seconds; None where nothing was to come back.

    Parameters
    ----------
    states, voice
        Longest times without.
    states_back, voice_back
        From the moment at which the new process listens.
    stood
        Whether Ada then stood where she had.
    """

    states: float
    voice: float
    states_back: float | None
    voice_back: float | None
    stood: bool


def longest(times_ms: list[float], begun: float, ended: float) -> float:
    """Seconds of the longest pause from begin to end."""
    inside = [begun, *(at for at in times_ms if begun < at < ended), ended]
    return max(b - a for a, b in itertools.pairwise(inside)) / 1000


def back(times_ms: list[float], since: float) -> float | None:
    """Seconds until the first one after a moment."""
    return next(((at - since) / 1000 for at in times_ms if at >= since), None)


async def clock_ms(tab: Tab) -> float:
    """The page's clock: all times are by it."""
    return float(await tab.ask("Date.now()"))


async def notice(what: str, *, away: float, folder: Path) -> Noticed:
    """One meeting in which something is killed."""
    write_bursts(folder / "speech.wav")
    sound = f"--use-file-for-fake-audio-capture={folder / 'speech.wav'}"
    async with AsyncExitStack() as stack:
        part = stack.enter_context(ExitStack())
        ports, wire = [free_port(), free_port()], free_port()
        options: tuple[str, ...] = ()
        start: Callable[[], object] | None = None
        if what == "redis":
            start, options = (lambda: redis(wire)), ("--redis", f"redis://127.0.0.1:{wire}/0")
        elif what == "janus":
            (folder / "janus.secret").write_text(API_SECRET)
            start = lambda: janus(wire, folder)  # noqa: E731
            options = ("--janus", f"ws://127.0.0.1:{wire}", "--janus-secret", str(folder / "janus.secret"))
        elif what == "server":
            start = lambda: server(folder, ports[0])  # noqa: E731
        killed = part.enter_context(start()) if start else None
        if what != "server":
            stack.enter_context(server(folder, ports[0], *options))
        if what == "redis":
            stack.enter_context(server(folder, ports[1], *options))
        key = load_keys(folder / "room.keys").key("meeting", "guest")
        browser = await stack.enter_async_context(chromium(*AWAKE, sound))
        tabs = []
        for name, port in zip(("Ada", "Ben"), (ports[0], ports[what == "redis"]), strict=True):
            link = f"http://127.0.0.1:{port}/room/meeting#{key}"
            tabs.append(await stack.enter_async_context(browser.open(link)))
            await come_in(tabs[-1], name)
        ada, ben = tabs
        third = None
        if what == "browser":
            third = await stack.enter_async_context(chromium(*AWAKE, sound))
            tab = await stack.enter_async_context(
                third.open(f"http://127.0.0.1:{ports[0]}/room/meeting#{key}")
            )
            await come_in(tab, "Cem")
        await ada.ask(f"void Object.assign(meeting.presence.walk, {{ x: {STANDS['x']}, z: {STANDS['z']} }})")
        await ben.until(f"{other('Ada')}?.newest?.floor_m[0] === {STANDS['x']}", 60)
        for tab in tabs:
            await tab.until(CONNECTED, 60)
        await ben.ask(WATCH)
        await asyncio.sleep(SETTLE_S)
        begun = await clock_ms(ben)
        await hit(what, killed, third)
        await asyncio.sleep(away)
        if start:
            part.close()
            listening = asyncio.to_thread(lambda: stack.enter_context(start()))
            await listening
        since = await clock_ms(ben)
        await asyncio.sleep(AFTER_S)
        ended = await clock_ms(ben)
        watched = await ben.ask("watched")
    states, packets = [at for at, *_ in watched["states"]], watched["packets"]
    later = [(x, z) for at, x, z in watched["states"] if at >= since]
    return Noticed(
        states=longest(states, begun, ended),
        voice=longest(packets, begun, ended),
        states_back=back(states, since) if start else None,
        voice_back=back(packets, since) if start else None,
        stood=bool(later) and set(later) == {(STANDS["x"], STANDS["z"])},
    )


async def hit(what: str, killed: object, third: object) -> None:
    """Kill it."""
    if what == "browser":
        third.kill()
    elif what != "nothing":
        killed.kill()


def row(what: str, found: list[Noticed]) -> str:
    """A line of the table: each of the rounds."""

    def told(get: Callable[[Noticed], float | None]) -> str:
        return ", ".join("-" if (value := get(each)) is None else f"{value:.2f}" for each in found)

    columns = (told(lambda each, name=name: getattr(each, name)) for name in
               ("states", "voice", "states_back", "voice_back"))  # fmt: skip
    return f"| {what} | {' | '.join(columns)} | {sum(each.stood for each in found)} of {len(found)} |"


KINDS = ("nothing", "server", "redis", "janus", "browser")


def main() -> None:
    """Kill each in turn, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kill", default=",".join(KINDS), help="of these, all by default")
    parser.add_argument("--times", type=int, default=3, help="that each is killed, 3 by default")
    parser.add_argument("--away", type=float, default=1.0, help="seconds until it is started again")
    options = parser.parse_args()
    if unknown := set(options.kill.split(",")) - set(KINDS):
        parser.error(f"--kill: does not know {', '.join(sorted(unknown))}; there are {', '.join(KINDS)}")
    print("| killed | s without a state | s without a packet of voice | s until states are back | s until voices are "
          "| stood where she had |\n|---|---|---|---|---|---|")  # fmt: skip
    for what in options.kill.split(","):
        found = []
        for _ in range(options.times):
            with tempfile.TemporaryDirectory() as folder:
                found.append(asyncio.run(notice(what, away=options.away, folder=Path(folder))))
        print(row(what, found), flush=True)
    print(f"\nload {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


if __name__ == "__main__":
    main()
