"""Makes docs/pictures/HEADSET.webp: every person of a dataset as the headset's cameras see them, pixel by pixel.

facegen generate datasets/gallery.toml --out datasets/out/gallery
python docs/figures/gallery.py datasets/out/gallery [NAME]
"""

import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from facegen.store import DatasetFolder, read_json, read_png

OUT = Path(__file__).resolve().parents[1] / "pictures"
FIRST = ("right", "left")
"""The subject's right first: it is at the left of a picture of the face."""
WIDTH_PX, GAP_PX = 1700, 8
"""At most; as many people a line as fit."""
LABEL_PX = 19
QUALITY = 92
"""Of WebP: noise of the sensor stays, and a page of twelve people has less than 400 kB."""


def main() -> None:
    """Read the views of each person, and write the sheet."""
    files = DatasetFolder(Path(sys.argv[1]))
    numbers = files.rendered()
    record = read_json(files.render(numbers[0]) / "sample.json")
    views = sorted(record["views"], key=_place)
    people = [[read_png(files.render(number) / f"{view}.png") for view in views] for number in numbers]
    name = sys.argv[2] if len(sys.argv) > 2 else record["headset"]["name"]
    Image.fromarray(sheet(people, views)).save(OUT / f"{name}.webp", quality=QUALITY, method=6)


def sheet(people: Sequence[Sequence[np.ndarray]], views: Sequence[str]) -> np.ndarray:
    """People side by side, a gap between them, under each person's number and the views' names."""
    cells = []
    for number, pictures in enumerate(people, start=1):
        wide = np.cumsum([0, *(picture.shape[1] for picture in pictures)])
        label = Image.new("L", (int(wide[-1]), LABEL_PX))
        draw, font = ImageDraw.Draw(label), ImageFont.load_default(size=11.5)
        for left, view in zip(wide, views, strict=False):
            words = view.replace("_", " ")
            draw.text((int(left) + 3, 2), f"{number}  {words}" if left == 0 else words, fill=205, font=font)
        cell = np.concatenate([np.asarray(label), np.concatenate(pictures, axis=1)])
        cells.append(np.pad(cell, ((0, GAP_PX), (0, GAP_PX))))
    columns = max(WIDTH_PX // cells[0].shape[1], 1)
    empty = [np.zeros_like(cells[0])] * (-len(cells) % columns)
    cells += empty
    return np.concatenate(
        [np.concatenate(cells[i : i + columns], axis=1) for i in range(0, len(cells), columns)]
    )


def _place(view: str) -> tuple[int, str]:
    """Eyes before brows before mouth, each the subject's right side first."""
    kind = next((i for i, word in enumerate(("eye", "brow")) if word in view), 2)
    side = next((i for i, word in enumerate(FIRST) if word in view.split("_")), 2)
    return kind, f"{side}{view}"


if __name__ == "__main__":
    main()
