"""A person's own face in the room's page: a real face before a fake camera, held against what `track` makes of it."""

import asyncio
from pathlib import Path

import cv2
import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress import load_model
from regress.runtime.sample import Sample
from tests.browser import chromium, needs_chromium
from tests.room.bare_place import BARE
from tests.room.guests import open_room
from tests.room.page import AWAKE
from tests.track.faces import seen

PARTS = Path(__file__).resolve().parents[2] / "room/server/static/face"

pytestmark = [
    needs_chromium,
    pytest.mark.slow,
    pytest.mark.skipif(not (PARTS / "face.js").exists(), reason="`make room-face` has not been run"),
]

MEETING = """(() => {
  const form = document.querySelector('#join');
  form.elements.name.value = 'Ada';
  form.elements.voice.click();
  form.elements.camera.checked = true;
  form.requestSubmit();
})()"""
FACE = """(() => {
  const face = meeting.presence.camera.found;  // the last one, also where a busy machine sees one a second
  return face && { weights: [...face.weights], head: face.head, tracked: face.tracked };
})()"""


COUNT = """void ((camera) => {
  globalThis.faces = 0;
  const { hear } = camera;
  camera.hear = (message) => {
    hear.call(camera, message);
    globalThis.faces += message.kind === 'face';
  };
})(meeting.presence.camera)"""
STEPS = 10
"""Pictures of one face, by which a detector has settled on it."""


async def by_the_page(folder: Path, picture: np.ndarray) -> tuple[dict, dict]:
    """What the page makes of a picture, before and after it was said to be the neutral face."""
    film = folder / "film.mjpeg"
    film.write_bytes(cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, 98])[1].tobytes() * 2)
    camera = f"--use-file-for-fake-video-capture={film}"
    async with open_room(places=BARE) as place, chromium(*AWAKE, camera) as browser:
        link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
        async with browser.open(link) as tab:
            await tab.until("document.querySelector('#join select[name=avatar]')?.value")
            await tab.ask(MEETING)
            await tab.until("globalThis.meeting?.own")
            await tab.ask("void (meeting.stage.drawing = false)")
            await tab.ask(COUNT)
            await tab.until(f"faces >= {STEPS}")
            before = await tab.ask(FACE)
            assert "neutral face" in await tab.ask("meeting.presence.camera.word")
            await tab.ask("document.querySelector('#neutral').click()")
            await tab.until("meeting.presence.camera.word === ''")
            await tab.until(
                f"(({{ weights, head }}) => Math.max(...weights, ...head.map(Math.abs)) < 0.03)({FACE})"
            )
            after = await tab.ask(FACE)
            await tab.until("meeting.presence.sent.flags & 2")  # others are told that a camera sees this face
            assert {address.split("/")[2] for address in tab.asked if address.startswith(("http", "ws"))} == {
                place.address.split("/")[2]
            }
            return before, after


def test_the_page_sees_what_track_sees(tmp_path):
    from track.detectors.mediapipe import MediapipeDetector

    picture = seen(turned_deg=10, zoom=1.1)
    before, after = asyncio.run(by_the_page(tmp_path, picture))
    detector = MediapipeDetector()
    for step in range(STEPS):
        sample = detector.step(Sample(time_s=step / 30, pictures={"camera": picture}))
    detector.close()
    weights = load_model("landmarks-default").predict(sample.points[None])[0]
    ours = np.array([index for index, name in enumerate(BLENDSHAPES) if "eyeLook" not in name])
    difference = np.abs(np.array(before["weights"]) - np.clip(weights, 0, 1))[ours]
    print(f"weights: mean difference {difference.mean():.4f}, most {difference.max():.4f}")
    assert weights[ours].max() > 0.3, "the face is no neutral one"
    assert difference.mean() < 0.02
    yaw, pitch, roll = np.degrees(np.abs(np.array(before["head"]) - sample.head[3:]))
    assert max(yaw, roll) < 3
    assert pitch < 8, (
        "MediaPipe's own head looks down at rest; track fits another, and the neutral face takes it away"
    )
    assert abs(np.degrees(sample.head[5])) > 5, "the head is turned, so that a wrong sign shows"
    assert np.abs(np.array(after["weights"])).max() < 0.1, "the neutral face is one"
    assert np.degrees(np.abs(after["head"])).max() < 2
