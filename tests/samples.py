"""The answers of the ready-made models that docs/samples keeps, and whether a table holds the same."""

import csv
from pathlib import Path

import numpy as np

SAMPLES = Path(__file__).parents[1] / "docs" / "samples"

AGREEMENT, AGREEMENT_DEG = 1e-5, 1e-3
"""Largest difference of a weight and of an angle from the recorded one; tables have six decimals."""

RECORDED_EVERY = 10
"""Rows of the landmarks' answers that docs/samples keeps (docs/samples/collect.py)."""

FACE = (SAMPLES / "talking-face.csv", "--neutral", "1-30")
"""What `regress predict` is asked of the talking face."""

_CAMERAS = ("left_eye", "right_eye", "mouth")
PICTURES = (
    *(word for name in _CAMERAS for word in ("--camera", f"{name}={SAMPLES / 'headset' / name}")),
    *("--neutral", "0"),
)
"""What `regress headset predict` is asked of the three cameras."""


def rows(path: Path) -> tuple[list[str], np.ndarray]:
    """Column names and values (frames, columns) of a table."""
    with path.open(newline="", encoding="utf-8") as file:
        header, *lines = csv.reader(file)
    return header, np.array([[float(cell or "nan") for cell in line] for line in lines])


def assert_face_as_recorded(table: Path) -> None:
    """The table holds what docs/samples says of the talking face."""
    (header, weights), (names, recorded) = rows(table), rows(SAMPLES / "talking-face.weights.csv")
    assert header == names
    np.testing.assert_allclose(weights[::RECORDED_EVERY], recorded, rtol=0, atol=AGREEMENT)
    assert np.ptp(recorded[:, header.index("jawOpen")]) > 0.1


def assert_headset_as_recorded(table: Path) -> None:
    """The table holds what docs/samples says of the headset's pictures."""
    (header, weights), (names, recorded) = rows(table), rows(SAMPLES / "headset.weights.csv")
    assert header == names
    degrees = np.array([name.endswith("_deg") for name in header])
    np.testing.assert_allclose(weights[:, ~degrees], recorded[:, ~degrees], rtol=0, atol=AGREEMENT)
    np.testing.assert_allclose(weights[:, degrees], recorded[:, degrees], rtol=0, atol=AGREEMENT_DEG)
