"""A headset's three films go through ``track --to room:``, and others in the room see what the networks find."""

import asyncio
import csv
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from room.protocol import Flag, Message
from tests.room.guests import open_room

SAMPLES = Path(__file__).resolve().parents[2] / "docs" / "samples"
CAMERAS = ("left_eye", "right_eye", "mouth")
TIMES = 6
"""That the films are shown one after the other: a room takes thirty states a second, of a hundred that are answered.
Shown twice on a loaded machine, 17 of the hundred were seen."""


def films(folder: Path) -> None:
    """The cameras' pictures, as often as `TIMES` says."""
    for name in CAMERAS:
        pictures = sorted((SAMPLES / "headset" / name).iterdir())
        (folder / name).mkdir()
        for number, picture in enumerate(pictures * TIMES):
            shutil.copy(picture, folder / name / f"{number:04d}{picture.suffix}")


async def worn(folder: Path) -> tuple[list[Message], set[str], int]:
    """What somebody in the room gets of a face under a headset, who moves it, and the program's exit code."""
    async with open_room() as place:
        ada, bob = await place.guest(), await place.guest(name="Bob")
        link = f"{place.address}/room/{place.name}#{place.join().key}.{ada.secret}"
        cameras = [word for name in CAMERAS for word in ("--camera", f"{name}={folder / name}")]
        process = await asyncio.create_subprocess_exec(
            *(
                sys.executable,
                "-m",
                "track",
                *cameras,
                "--fast",  # every frame is answered, however busy the machine is
                "--no-page",
                "--filter",
                "none",
                "--to",
                f"room:{link}",
            ),
            stderr=asyncio.subprocess.PIPE,
        )
        ended = asyncio.ensure_future(process.communicate())
        seen: list[Message] = []
        while not ended.done():
            await asyncio.wait({ended}, timeout=0.005)
            state = bob.states.get(ada.number)
            if state and state not in seen[-1:]:
                seen.append(state)
        faces = {answer.person.face for answer in bob.answers if getattr(answer, "kind", "") == "person"}
        return seen, faces, process.returncode


@pytest.mark.slow
def test_a_headset_s_films_move_a_face_in_the_room(tmp_path: Path):
    films(tmp_path)
    seen, faces, code = asyncio.run(asyncio.wait_for(worn(tmp_path), 1200))
    assert code == 0
    assert "program" in faces
    with open(SAMPLES / "headset.weights.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    answered = np.array([[float(row[name]) for name in BLENDSHAPES] for row in rows])
    tracked = [state for state in seen if state.flags & Flag.TRACKED]
    number = [(state.sequence - 1) % len(rows) for state in tracked]
    assert len(set(number)) > 20, "hardly a face of the hundred is seen"
    shown, known = np.array([state.weights for state in tracked]), answered[number]
    moving = known.std(axis=0) > 0.08
    fits = [np.corrcoef(shown[:, shape], known[:, shape])[0, 1] for shape in np.flatnonzero(moving)]
    print(
        f"{len(set(number))} of {len(rows)} frames; r of {moving.sum()} moving shapes: {np.round(np.sort(fits), 2)}"
    )
    assert np.median(fits) > 0.95, "the room shows what `regress headset predict` answers"
