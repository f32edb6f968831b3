"""Makes docs/pictures/tracking3.png: every person of a dataset as the headset's cameras see them, pixel by pixel.

facegen generate datasets/gallery.toml --out datasets/out/gallery
python docs/figures/gallery.py datasets/out/gallery
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

from facegen.store import DatasetFolder, read_json, read_png

OUT = Path(__file__).resolve().parents[1] / "pictures"
VIEWS = ("right_eye", "left_eye", "mouth")
"""The subject's right eye first: it is at the left of a picture of the face."""
COLUMNS, GAP_PX = 2, 8


def main() -> None:
    """Two people a line, a gap between people."""
    files = DatasetFolder(Path(sys.argv[1]))
    numbers = files.rendered()
    headset = read_json(files.render(numbers[0]) / "sample.json")["headset"]["name"]
    people = [
        np.concatenate([read_png(files.render(n) / f"{view}.png") for view in VIEWS], axis=1) for n in numbers
    ]
    padded = [np.pad(person, ((0, GAP_PX), (0, GAP_PX))) for person in people]
    lines = [np.concatenate(padded[i : i + COLUMNS], axis=1) for i in range(0, len(padded), COLUMNS)]
    Image.fromarray(np.concatenate(lines)).save(OUT / f"{headset}.png", optimize=True)


if __name__ == "__main__":
    main()
