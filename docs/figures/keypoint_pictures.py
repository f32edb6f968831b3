"""Makes docs/pictures/keypoint-pictures.webp: rendered faces with the keypoints of their COCO file.

facegen generate docs/examples/keypoints.toml --out datasets/out/keypoints --samples 0-999:51
facegen pack datasets/out/keypoints --format coco --out datasets/out/keypoints-coco --samples 0-999:51
python docs/figures/keypoint_pictures.py datasets/out/keypoints datasets/out/keypoints-coco/keypoints-front.json
"""

import json
import sys
from pathlib import Path

from PIL import Image, ImageDraw

OUT = Path(__file__).resolve().parents[1] / "pictures" / "keypoint-pictures.webp"
COLUMNS, ROWS = 4, 2
FINER, RADIUS_PX = 2, 2
COLOURS = {1: (255, 60, 60), 2: (60, 255, 60)}
"""By COCO's numbers: hidden, visible."""


def main() -> None:
    """Draw the first pictures of the file, each with its keypoints."""
    folder, labels = Path(sys.argv[1]), json.loads(Path(sys.argv[2]).read_text(encoding="utf-8"))
    faces = {face["image_id"]: face["keypoints"] for face in labels["annotations"]}
    shown = labels["images"][: COLUMNS * ROWS]
    width, height = shown[0]["width"] * FINER, shown[0]["height"] * FINER
    sheet = Image.new("RGB", (COLUMNS * width, ROWS * height))
    for index, image in enumerate(shown):
        cell = dotted(Image.open(folder / image["file_name"]), faces[image["id"]])
        sheet.paste(cell, (index % COLUMNS * width, index // COLUMNS * height))
    sheet.save(OUT, quality=88, method=6)


def dotted(picture: Image.Image, keypoints: list[float]) -> Image.Image:
    """The picture, larger, with a dot at each labelled keypoint; pixels are counted from the middle of the first."""
    image = picture.convert("RGB").resize((picture.width * FINER, picture.height * FINER))
    draw = ImageDraw.Draw(image)
    for x, y, seen in zip(*[iter(keypoints)] * 3, strict=True):
        if seen:
            u, v = FINER * (x + 0.5) - 0.5, FINER * (y + 0.5) - 0.5
            draw.ellipse((u - RADIUS_PX, v - RADIUS_PX, u + RADIUS_PX, v + RADIUS_PX), fill=COLOURS[seen])
    return image


if __name__ == "__main__":
    main()
