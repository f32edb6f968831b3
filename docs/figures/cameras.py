"""Draws docs/pictures/cameras.jpg: what a detector gives of a picture, and whom it follows.

    python docs/figures/cameras.py

The face is NASA's portrait of Eileen Collins (tests/track/pictures); MediaPipe's model file is fetched where it is not
there yet.
"""

import sys
from pathlib import Path

import cv2
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from facegen.conventions import LANDMARK_GROUPS  # noqa: E402
from regress.runtime.sample import Sample  # noqa: E402
from tests.track.faces import MIDDLE, photograph  # noqa: E402
from track.detectors import FaceFault, MediapipeDetector  # noqa: E402
from track.detectors.head import rotation_of, typical_camera  # noqa: E402

OUT = ROOT / "docs" / "pictures" / "cameras.jpg"
WIDTH, HEIGHT = 640, 480
CLOSED = ("right_eye", "left_eye", "outer_lip", "inner_lip")
POINT, LINE, IRIS, OTHER = (255, 255, 255), (210, 190, 60), (60, 160, 255), (40, 40, 220)
AXIS_M = 0.07


def placed(zoom: float, *, aside: float = 0.0, turned_deg: float = 0.0) -> np.ndarray:
    """The portrait in a picture of 640 x 480, its face in the middle or aside by pixels."""
    matrix = cv2.getRotationMatrix2D(MIDDLE, turned_deg, zoom)
    matrix[:, 2] += np.array([WIDTH / 2 + aside, HEIGHT / 2]) - MIDDLE
    return cv2.warpAffine(
        photograph(), matrix, (WIDTH, HEIGHT), flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE
    )


def drawn(picture: np.ndarray, sample: Sample) -> np.ndarray:
    """The picture with points, irises and the head's axes."""
    picture = picture.copy()
    for name, rows in LANDMARK_GROUPS.items():
        line = sample.points[list(rows)].round().astype(np.int32)
        cv2.polylines(picture, [line], name in CLOSED, LINE, 1, cv2.LINE_AA)
    for x, y in sample.points:
        cv2.circle(picture, (round(x), round(y)), 2, POINT, -1, cv2.LINE_AA)
    for x, y in sample.irises:
        cv2.circle(picture, (round(x), round(y)), 8, IRIS, 2, cv2.LINE_AA)
    camera = typical_camera(WIDTH, HEIGHT)
    ends = sample.head[:3] + np.vstack([np.zeros(3), AXIS_M * rotation_of(sample.head).T])
    ends = ends[:, :2] / ends[:, 2:] * camera.focal_px + camera.centre_px
    start, *tips = [tuple(round(value) for value in end) for end in ends]
    for tip, colour in zip(tips, ((60, 60, 230), (80, 200, 80), (230, 120, 60)), strict=True):
        cv2.arrowedLine(picture, start, tip, colour, 3, cv2.LINE_AA, tipLength=0.15)
    return picture


def detected(detector: MediapipeDetector, picture: np.ndarray, time_s: float) -> Sample:
    """What is found after some pictures of the same."""
    for frame in range(3):
        sample = detector.step(Sample(time_s=time_s + frame / 30, pictures={"camera": picture}))
    return sample


def main() -> None:
    """A face in the middle, one aside, and two of which the left one was there first."""
    panels = []
    for number, picture in enumerate((placed(2.2), placed(2.2, aside=90, turned_deg=-14))):
        detector = MediapipeDetector()
        panels.append(drawn(picture, detected(detector, picture, number)))
        detector.close()
    detector = MediapipeDetector()
    wall = np.full((HEIGHT, WIDTH, 3), 120, np.uint8)
    middle = np.s_[:, WIDTH // 4 : -WIDTH // 4]
    first, second = placed(1.9)[middle], placed(2.2)[middle]
    detected(detector, np.hstack([first, wall[middle]]), 0.0)
    both = np.hstack([first, second])
    sample = detected(detector, both, 0.2)
    assert sample.faults == {"points": FaceFault.OTHERS}
    both = drawn(both, sample)
    cv2.rectangle(both, (WIDTH // 2 + 55, 130), (WIDTH // 2 + 275, 405), OTHER, 3)
    cv2.rectangle(both, (WIDTH // 2 + 54, 102), (WIDTH // 2 + 164, 130), OTHER, -1)
    cv2.putText(both, "ignored", (WIDTH // 2 + 62, 123), cv2.FONT_HERSHEY_SIMPLEX, 0.7, POINT, 2, cv2.LINE_AA)
    detector.close()
    cv2.imwrite(str(OUT), np.hstack([*panels, both]), [cv2.IMWRITE_JPEG_QUALITY, 82])


if __name__ == "__main__":
    main()
