"""A real face before a camera: the astronaut's picture, moved, turned and zoomed."""

from pathlib import Path

import cv2
import numpy as np

from facegen.formats.film import encode_film

FILE = Path(__file__).parent / "pictures" / "astronaut.jpg"
MIDDLE = (144.0, 120.0)
"""Of the face in the file, in pixels."""

WIDTH, HEIGHT = 320, 240


def photograph() -> np.ndarray:
    """Pixels (300, 300, 3), blue green red."""
    return cv2.imread(str(FILE))


def seen(
    *, beside: tuple[float, float] = (0.0, 0.0), turned_deg: float = 0.0, zoom: float = 1.0
) -> np.ndarray:
    """The face in a picture of 320 x 240, in its middle unless moved beside by pixels; turned anticlockwise."""
    matrix = cv2.getRotationMatrix2D(MIDDLE, turned_deg, 0.8 * zoom)
    matrix[:, 2] += np.array([WIDTH / 2, HEIGHT / 2]) + beside - MIDDLE
    return cv2.warpAffine(photograph(), matrix, (WIDTH, HEIGHT), borderMode=cv2.BORDER_REPLICATE)


def two_faces(*, left_zoom: float | None, right_zoom: float | None) -> np.ndarray:
    """Two faces side by side in a picture of 320 x 240; None is nobody there, before a grey wall."""
    middle = np.s_[:, WIDTH // 4 : -WIDTH // 4]
    wall = np.full((HEIGHT, WIDTH, 3), 120, np.uint8)
    sides = [wall if zoom is None else seen(zoom=zoom) for zoom in (left_zoom, right_zoom)]
    return np.hstack([side[middle] for side in sides])


def moving(count: int) -> list[np.ndarray]:
    """Pictures of a face that sways, nods aside and comes near."""
    pictures = []
    for phase in np.linspace(0, 2 * np.pi, count, endpoint=False):
        aside, near = float(np.sin(phase)), float(np.cos(phase))
        pictures.append(seen(beside=(25 * aside, 8 * near), turned_deg=12 * aside, zoom=1 + 0.1 * near))
    return pictures


def film_of(path: Path, pictures: list[np.ndarray], *, fps: float = 30.0) -> Path:
    """A film of pictures that are blue green red."""
    encode_film(path, (picture[..., ::-1] for picture in pictures), fps=fps)
    return path
