"""Each folder of the page's sources is one noun, and takes from those above it alone."""

import re
from pathlib import Path

SOURCES = Path(__file__).resolve().parents[2] / "web" / "room"
FOLDERS = {
    "keys": "which keys are the meeting's",
    "line": "the socket to the room, and what goes over it",
    "voice": "microphone, connections and sounds",
    "door": "what is asked before one comes in",
    "face": "one's own face by a camera",
    "figure": "a person as they are drawn, from colours to fingers",
    "people": "who is in the room, what they wear, and how their states are played",
    "scene": "the place, how it is walked and seen, and where people point",
    "presence": "where one stands oneself, also with a headset",
    "sharing": "windows, files and the screens that show them",
    "page": "what stands around the picture: list, chat, controls, status",
    ".": "what ties the others together",
}
"""From the first, which knows none of the others, to the last."""


def test_folders_take_from_those_above_alone():
    order = list(FOLDERS)
    against = []
    for source in SOURCES.rglob("*.ts"):
        folder = source.parent.relative_to(SOURCES).as_posix()
        if folder == "tests":
            continue
        for path in re.findall(r'(?:from |import\()"(\.[^"]+)"', source.read_text(encoding="utf-8")):
            taken = (source.parent / path).resolve().parent
            if not taken.is_relative_to(SOURCES):
                continue  # avatars and elements, which the page of track has too
            if order.index(taken.relative_to(SOURCES).as_posix()) > order.index(folder):
                against.append(f"{source.relative_to(SOURCES)} takes {path}")
    assert against == []


def test_every_folder_says_what_it_is_for():
    there = {path.parent.relative_to(SOURCES).as_posix() for path in SOURCES.rglob("*.ts")}
    assert there - {"tests"} == set(FOLDERS)
