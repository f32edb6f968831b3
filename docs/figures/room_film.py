"""Films docs/pictures/room-film.webp: three people meet in the operating room, as a fourth one sees them.

    python docs/figures/room_film.py

The three are programs that send states, as pages do. Pictures are taken one by one: the page's clock stands still while
one is drawn, so that the film runs evenly however slowly software draws. Needs Chromium, pillow, and the rig
(`make rig`) for one of the people.
"""

import asyncio
import io
import math
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(Path(__file__).parent)]

from room_page import come_in, dressed, only_the_room, stand  # noqa: E402
from room_people import PURPLE, SAND, dressed_guest, secret_of  # noqa: E402

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES  # noqa: E402
from room.places import read_place  # noqa: E402
from room.protocol import Animation, Flag  # noqa: E402
from tests.browser import Tab, chromium  # noqa: E402
from tests.room.guests import Guest, open_room  # noqa: E402

OUT = ROOT / "docs/pictures/room-film.webp"
FPS, LASTS_S = 10, 9.5
SETTLE_S = 1.0
"""Before the first picture: arms sink from how they were modelled."""
SIZE = (560, 360)
MOST_BYTES = 500_000
EYE = {"x": 0.02, "z": 0.5, "heading": math.pi, "pitch": -0.06}
STATES_PER_PICTURE = 3
"""30 a second, about as many as a page sends: limbs and faces are shown between them."""

Look = tuple[dict[str, float], int, int]
"""What face, flags and gesture are at a moment."""


def ease(time_s: float, start_s: float, end_s: float) -> float:
    """From 0 to 1, softly."""
    share = min(1.0, max(0.0, (time_s - start_s) / (end_s - start_s)))
    return share * share * (3 - 2 * share)


def during(time_s: float, start_s: float, end_s: float, edge_s: float = 0.3) -> float:
    """1 between two moments, with soft edges."""
    return ease(time_s, start_s, start_s + edge_s) * (1 - ease(time_s, end_s - edge_s, end_s))


def face(
    time_s: float, *, smile: float, speech: float, wonder: float, blinks: tuple[float, ...]
) -> dict[str, float]:
    """Weights of a face that smiles, speaks or wonders, and blinks at moments."""
    closed = max((max(0.0, 1 - abs(time_s - at) / 0.1) for at in blinks), default=0.0)
    syllable = 0.5 + 0.5 * math.sin(17 * time_s) * math.cos(5.3 * time_s)
    shapes = {
        "jawOpen": 0.42 * speech * syllable,
        "mouthFunnel": 0.3 * speech * (0.5 + 0.5 * math.sin(9 * time_s)),
        "browInnerUp": 0.7 * wonder + 0.2 * speech,
    }
    for side in ("Left", "Right"):
        shapes |= {
            f"mouthSmile{side}": 0.8 * smile,
            f"cheekSquint{side}": 0.5 * smile,
            f"eyeBlink{side}": closed,
            f"browOuterUp{side}": 0.6 * wonder,
        }
    return shapes


def ada(time_s: float) -> dict[str, object]:
    """Waits, turns to who comes, waves, speaks."""
    waves, speaks = 1.6 < time_s < 3.5, 4.0 < time_s < 6.3
    return {
        "floor_m": (-0.22, -0.85),
        "heading": 0.1 + 0.25 * ease(time_s, 0.5, 1.6),
        "shapes": face(
            time_s,
            smile=during(time_s, 1.4, 9.4) * (0.45 if speaks else 0.9),
            speech=during(time_s, 4.0, 6.3),
            wonder=during(time_s, 0.8, 2.2),
            blinks=(0.6, 3.6, 6.5, 8.6),
        ),
        "flags": Flag.TRACKED | (Flag.SPEAKING if speaks else 0),
        "animation": Animation.WAVE if waves else 0,
        "turn": 0.25 * ease(time_s, 0.3, 1.1),
    }


def explaining(time_s: float) -> dict[str, tuple[float, ...]]:
    """Hands as of a headset: held out, thumbs up, beating with the words."""
    half, beat_m = math.sqrt(0.5), 0.035 * math.sin(6 * time_s)
    return {
        "left_hand": (0.16, 1.2 + beat_m, 0.3, 0.0, 0.0, -half, half),
        "right_hand": (-0.2, 1.15 - beat_m, 0.33, 0.0, 0.0, half, half),
    }


def ben(time_s: float) -> dict[str, object]:
    """Comes in from the right, nods, and answers with his hands as well."""
    walked = ease(time_s, 0.0, 2.6)
    speaks = 6.7 < time_s < 9.0
    gesture = Animation.NOD if 2.9 < time_s < 3.7 or 5.2 < time_s < 6.4 else 0
    return {
        "floor_m": (1.8 - 1.12 * walked, -1.2),
        "heading": -math.pi / 2 + 1.15 * ease(time_s, 2.2, 3.0),
        "shapes": face(
            time_s,
            smile=during(time_s, 2.2, 6.5) * 0.9 + during(time_s, 8.8, 12, 0.5) * 0.7,
            speech=during(time_s, 6.7, 9.0),
            wonder=during(time_s, 6.6, 7.6),
            blinks=(1.5, 4.4, 7.7),
        ),
        "flags": Flag.TRACKED | (Flag.SPEAKING | Flag.HANDS if speaks else 0),
        "animation": gesture,
        "turn": -0.22 * ease(time_s, 2.2, 3.0),
        "hands": explaining(time_s) if speaks else {},
    }


def mei(time_s: float) -> dict[str, object]:
    """Stands behind and between the two, looks at who comes, then at who speaks, and nods."""
    turn = 0.4 * ease(time_s, 0.5, 1.2) - 0.75 * ease(time_s, 3.6, 4.3) + 0.75 * ease(time_s, 6.6, 7.3)
    return {
        "floor_m": (0.21, -1.6),
        "heading": 0.0,
        "shapes": face(
            time_s,
            smile=0.25 + 0.45 * during(time_s, 2.6, 5.4, 0.6),
            speech=0.0,
            wonder=during(time_s, 7.0, 8.2),
            blinks=(1.1, 2.9, 5.2, 7.1, 9.1),
        ),
        "flags": Flag.TRACKED,
        "animation": Animation.NOD if 5.3 < time_s < 6.3 else 0,
        "turn": turn,
    }


async def tell(guest: Guest, acted: dict[str, object], time_ms: int) -> None:
    """Send one moment of a person; eyes go as far again as the head turns."""
    weights = [0.0] * len(BLENDSHAPES)
    for name, weight in acted["shapes"].items():
        weights[BLENDSHAPE_INDEX[name]] = weight
    turn = acted["turn"]
    await guest.move(
        weights=tuple(weights),
        rotation=(0.0, math.sin(turn / 2), 0.0, math.cos(turn / 2)),
        gaze=(turn / 2, 0.0, turn / 2, 0.0),
        floor_m=acted["floor_m"],
        heading=acted["heading"],
        flags=int(acted["flags"]),
        animation=int(acted["animation"]),
        **acted.get("hands", {}),
        sequence=time_ms,
        time_ms=time_ms,
    )


async def picture(tab: Tab, folder: Path, time_ms: int) -> Image.Image:
    """Let the page's clock go on to a moment, draw, and look."""
    newest = "[...meeting.known.values()].filter(({ person }) => person.name !== 'Eve').every"
    await tab.until(f"{newest}(({{ newest }}) => newest?.time_ms >= {time_ms})")
    # the page itself draws nothing: software would draw without an end
    await tab.ask(
        f"(globalThis.clock = {time_ms}, new Promise((moved) => requestAnimationFrame(() => moved())))"
    )
    await tab.ask("void meeting.stage.view.draw()")
    path = folder / "picture.png"
    await tab.picture(path)
    return Image.open(io.BytesIO(path.read_bytes())).convert("RGB")


async def film(folder: Path) -> list[Image.Image]:
    """All pictures."""
    operating = {"": read_place("operating")}
    async with open_room(places=operating) as place, chromium("--use-fake-ui-for-media-stream") as browser:
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        people = [
            (await place.guest(name="Ada", avatar="nora", secret=secret_of("Ada", PURPLE, 1)), ada),
            (await place.guest(name="Ben", avatar="omar", secret=secret_of("Ben", SAND)), ben),
            (await dressed_guest(place, name="Mei", avatar="mei"), mei),
        ]
        for guest, act in people:
            await guest.say(kind="voice", open=True)
            await tell(guest, act(0.0), 0)
        async with browser.open(link) as tab:
            await tab.look(width=SIZE[0], height=SIZE[1])
            await come_in(tab, "Eve")
            await tab.ask("void (meeting.stage.drawing = false)")
            await only_the_room(tab)
            await stand(tab, **EYE)
            await dressed(tab)
            await tab.ask("void (globalThis.clock = 0, performance.now = () => globalThis.clock)")
            await tab.ask("for (const { playback } of meeting.known.values()) playback.restart()")
            pictures = []
            for step in range(round(FPS * (SETTLE_S + LASTS_S)) * STATES_PER_PICTURE):
                time_ms = 1 + round(1000 * step / FPS / STATES_PER_PICTURE)
                for guest, act in people:
                    await tell(guest, act(time_ms / 1000 - SETTLE_S), time_ms)
                if step % STATES_PER_PICTURE == 0:
                    drawn = await picture(tab, folder, time_ms)
                    pictures += [drawn] if time_ms > 1000 * SETTLE_S else []
                    print(f"\r{len(pictures)} pictures", end="", file=sys.stderr)
            print(f"\ncomplaints: {tab.complaints}", file=sys.stderr)
            return pictures


def main() -> None:
    """Film, and write the largest quality that fits."""
    with tempfile.TemporaryDirectory() as folder:
        pictures = asyncio.run(film(Path(folder)))
    for quality in range(62, 10, -8):
        pictures[0].save(
            OUT,
            save_all=True,
            append_images=pictures[1:],
            duration=round(1000 / FPS),
            loop=0,
            quality=quality,
            method=4,
        )
        if OUT.stat().st_size <= MOST_BYTES:
            break
    print(
        f"{OUT.relative_to(ROOT)}: {len(pictures)} pictures, quality {quality}, {OUT.stat().st_size // 1000} kB"
    )


if __name__ == "__main__":
    main()
