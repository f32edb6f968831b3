"""Makes docs/pictures/HEADSET.png: every person of a dataset as the headset's cameras see them, pixel by pixel.

facegen generate datasets/gallery.toml --out datasets/out/gallery
python docs/figures/gallery.py datasets/out/gallery
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

from facegen.store import DatasetFolder, read_json, read_png

OUT = Path(__file__).resolve().parents[1] / "pictures"
FIRST = ("right", "left")
"""The subject's right first: it is at the left of a picture of the face."""
WIDTH_PX, GAP_PX = 1700, 8
"""At most; as many people a line as fit."""


def main() -> None:
    """People side by side, a gap between them."""
    files = DatasetFolder(Path(sys.argv[1]))
    numbers = files.rendered()
    record = read_json(files.render(numbers[0]) / "sample.json")
    views = sorted(record["views"], key=_place)
    people = [
        np.concatenate([read_png(files.render(n) / f"{view}.png") for view in views], axis=1) for n in numbers
    ]
    padded = [np.pad(person, ((0, GAP_PX), (0, GAP_PX))) for person in people]
    columns = max(WIDTH_PX // padded[0].shape[1], 1)
    lines = [np.concatenate(padded[i : i + columns], axis=1) for i in range(0, len(padded), columns)]
    picture = Image.fromarray(np.concatenate(lines))
    picture.save(OUT / f"{record['headset']['name']}.png", optimize=True)


def _place(view: str) -> tuple[int, str]:
    """Eyes before brows before mouth, each the subject's right side first."""
    kind = next((i for i, word in enumerate(("eye", "brow")) if word in view), 2)
    side = next((i for i, word in enumerate(FIRST) if word in view.split("_")), 2)
    return kind, f"{side}{view}"


if __name__ == "__main__":
    main()
