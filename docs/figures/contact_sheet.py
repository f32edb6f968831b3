"""Makes docs/pictures/contact-sheet.png, or NAME, of what `facegen preview` draws, smaller and in few colours.

facegen generate datasets/gallery.toml --out datasets/out/gallery
facegen preview datasets/out/gallery --samples 1,2,6,9,10,11 --out sheet.png
python docs/figures/contact_sheet.py sheet.png [paper.webp]
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

OUT = Path(__file__).resolve().parents[1] / "pictures"
WIDTH = 1800


def main() -> None:
    """Shrink to `WIDTH` at most; of a PNG keep 160 greys for the views and 90 colours for points and bars."""
    name = sys.argv[2] if len(sys.argv) > 2 else "contact-sheet.png"
    sheet = Image.open(sys.argv[1]).convert("RGB")
    if sheet.width > WIDTH:
        sheet = sheet.resize((WIDTH, round(WIDTH * sheet.height / sheet.width)), Image.LANCZOS)
    if name.endswith(".webp"):
        sheet.save(OUT / name, quality=78, method=6)
        return
    pixels = np.asarray(sheet).reshape(-1, 3)
    coloured = pixels[np.ptp(pixels, axis=1) > 24]
    colours = Image.fromarray(coloured[None]).quantize(90, method=Image.Quantize.MEDIANCUT).getpalette()[:270]
    greys = np.repeat(np.linspace(8, 255, 160).round().astype(int), 3).tolist()
    palette = Image.new("P", (1, 1))
    palette.putpalette(greys + colours)
    sheet.quantize(palette=palette, dither=Image.Dither.NONE).save(OUT / name, optimize=True)


if __name__ == "__main__":
    main()
