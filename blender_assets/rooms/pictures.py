"""Draws what the screens and the window of a room show, as JPEG."""

import io
import math

import numpy as np
from PIL import Image, ImageDraw, ImageFont

QUALITY = 88


def jpeg(picture: Image.Image, quality: int = QUALITY) -> bytes:
    """Bytes of a picture; every colour has its own pixel, so that thin lines keep theirs."""
    content = io.BytesIO()
    picture.convert("RGB").save(content, "JPEG", quality=quality, subsampling=0, optimize=True)
    return content.getvalue()


def _beat(phase: np.ndarray) -> np.ndarray:
    """One beat of an electrocardiogram, as five bumps: P, Q, R, S, T."""
    bumps = (
        (0.18, 0.025, 0.12),
        (0.27, 0.01, -0.14),
        (0.3, 0.012, 1.0),
        (0.33, 0.012, -0.24),
        (0.55, 0.045, 0.24),
    )
    return sum(height * np.exp(-(((phase - at) / width) ** 2) / 2) for at, width, height in bumps)


def _breath(phase: np.ndarray) -> np.ndarray:
    """Carbon dioxide of one breath: up, a plateau, down."""
    return (
        1
        / (1 + np.exp(-60 * (phase - 0.25)))
        * 1
        / (1 + np.exp(70 * (phase - 0.68)))
        * (0.85 + 0.3 * (phase - 0.25))
    )


def _pulse(phase: np.ndarray) -> np.ndarray:
    return np.exp(-(((phase - 0.25) / 0.09) ** 2)) + 0.45 * np.exp(-(((phase - 0.5) / 0.11) ** 2))


def vital_signs(size: tuple[int, int] = (768, 480)) -> bytes:
    """A patient's monitor: four curves and their numbers."""
    width, height = size
    picture = Image.new("RGB", size, (6, 12, 15))
    pen = ImageDraw.Draw(picture)
    rows = (
        ("HR", "72", (95, 230, 120), _beat, 7.0, 0.78),
        ("ABP", "118/74", (240, 95, 85), _pulse, 7.0, 0.62),
        ("SpO2", "98", (90, 205, 240), _pulse, 7.0, 0.5),
        ("CO2", "36", (245, 215, 100), _breath, 2.4, 0.62),
    )
    tall = (height - 34) / len(rows)
    pen.rectangle((0, 0, width, 26), fill=(18, 40, 46))
    pen.text((12, 5), "OR 2", fill=(190, 215, 215), font=ImageFont.load_default(16))
    pen.text((width - 64, 5), "10:24", fill=(190, 215, 215), font=ImageFont.load_default(16))
    for row, (name, number, colour, shape, times, reach) in enumerate(rows):
        top = 30 + row * tall
        x = np.arange(12, width * 0.72)
        y = shape((x / (width * 0.72) * times) % 1.0)
        line = [(float(a), float(top + tall * (0.86 - reach * b))) for a, b in zip(x, y, strict=True)]
        pen.line(line, fill=colour, width=3, joint="curve")
        pen.text((width * 0.745, top + 10), name, fill=colour, font=ImageFont.load_default(18))
        pen.text(
            (width * 0.745, top + 30),
            number,
            fill=colour,
            font=ImageFont.load_default(52 if len(number) < 4 else 36),
        )
        pen.line((0, top + tall, width, top + tall), fill=(22, 34, 38), width=1)
    return jpeg(picture)


def ventilator(size: tuple[int, int] = (512, 384)) -> bytes:
    """The anaesthesia machine's screen: pressure, flow, and a row of settings."""
    width, height = size
    picture = Image.new("RGB", size, (9, 16, 22))
    pen = ImageDraw.Draw(picture)
    for row, colour in enumerate(((120, 220, 230), (235, 190, 90))):
        top = 16 + row * 128
        x = np.arange(14, width - 120)
        phase = (x / 130.0) % 1.0
        y = (
            _breath(phase)
            if row == 0
            else np.where(phase < 0.3, np.sin(phase / 0.3 * np.pi), -0.8 * np.exp(-(phase - 0.3) * 9))
        )
        middle = top + (104 if row == 0 else 62)
        pen.line(
            [(float(a), float(middle - b * (84 if row == 0 else 50))) for a, b in zip(x, y, strict=True)],
            fill=colour,
            width=3,
        )
        pen.line((14, middle, width - 120, middle), fill=(40, 56, 62), width=1)
        pen.text((width - 104, top + 8), ("Paw", "Flow")[row], fill=colour, font=ImageFont.load_default(18))
        pen.text((width - 104, top + 32), ("18", "31")[row], fill=colour, font=ImageFont.load_default(48))
    for index, (name, value) in enumerate((("O2", "40"), ("Vt", "480"), ("f", "12"), ("PEEP", "5"))):
        left = 12 + index * (width - 24) / 4
        pen.rounded_rectangle((left, height - 92, left + 112, height - 14), 8, fill=(24, 44, 54))
        pen.text((left + 10, height - 86), name, fill=(150, 185, 190), font=ImageFont.load_default(16))
        pen.text((left + 10, height - 64), value, fill=(225, 238, 238), font=ImageFont.load_default(34))
    return jpeg(picture)


def scan(size: tuple[int, int] = (768, 432)) -> bytes:
    """Four slices of a body, as a tomograph shows them; drawn, nobody's."""
    width, height = size
    y, x = np.mgrid[0 : height // 2, 0 : width // 4].astype(float)
    slices = []
    for index in range(8):
        u, v = (x - width / 8) / (width / 8), (y - height / 4) / (height / 4)
        grey = np.zeros_like(x)
        grow = 0.78 + 0.05 * math.sin(index)
        parts = (
            (0, 0, 0.86, 0.72, 70),
            (0, 0, 0.8, 0.66, 105),
            (0.42, -0.1, 0.26, 0.34, 38 + 6 * index),
            (-0.42, -0.1, 0.26, 0.34, 44),
            (0, 0.42, 0.13, 0.14, 225),
            (0.02, -0.12, 0.18 + 0.012 * index, 0.22, 165),
            (0.1, 0.24, 0.07, 0.06, 190),
        )
        for cx, cy, rx, ry, level in parts:
            inside = ((u / grow - cx) / rx) ** 2 + ((v / grow - cy) / ry) ** 2
            grey = np.where(inside < 1, level * (1 - 0.12 * inside), grey)
        slices.append(grey + 4 * np.sin(x * 1.7 + index) * np.sin(y * 1.3) * (grey > 0))
    rows = [np.concatenate(slices[k : k + 4], axis=1) for k in (0, 4)]
    table = np.clip(np.concatenate(rows), 0, 255).astype(np.uint8)
    picture = Image.fromarray(table).convert("RGB")
    pen = ImageDraw.Draw(picture)
    for k in range(1, 4):
        pen.line((k * width / 4, 0, k * width / 4, height), fill=(40, 60, 66), width=2)
    pen.line((0, height / 2, width, height / 2), fill=(40, 60, 66), width=2)
    return jpeg(picture, 80)


def empty_screen(size: tuple[int, int] = (512, 288)) -> bytes:
    """The shared screen while nobody shares: what one does to use it."""
    picture = Image.new("RGB", size, (20, 44, 50))
    pen = ImageDraw.Draw(picture)
    middle = size[0] / 2
    pen.rounded_rectangle((middle - 44, 70, middle + 44, 128), 8, outline=(120, 175, 178), width=4)
    pen.line((middle, 128, middle, 146), fill=(120, 175, 178), width=4)
    pen.line((middle - 26, 148, middle + 26, 148), fill=(120, 175, 178), width=4)
    pen.line((middle, 114, middle, 84), fill=(120, 175, 178), width=4)
    pen.line((middle - 13, 97, middle, 84, middle + 13, 97), fill=(120, 175, 178), width=4)
    text = "Share a picture or a window"
    font = ImageFont.load_default(26)
    pen.text((middle - pen.textlength(text, font=font) / 2, 178), text, fill=(190, 220, 220), font=font)
    return jpeg(picture)


def clock(size: int = 192) -> bytes:
    """A wall clock's face at 10:24."""
    picture = Image.new("RGB", (size, size), (240, 243, 242))
    pen = ImageDraw.Draw(picture)
    half = size / 2
    for hour in range(60):
        angle = hour / 60 * 2 * math.pi
        inner = 0.76 if hour % 5 == 0 else 0.84
        pen.line(
            [(half + r * half * math.sin(angle), half - r * half * math.cos(angle)) for r in (inner, 0.9)],
            fill=(40, 50, 54),
            width=5 if hour % 5 == 0 else 2,
        )
    for angle, reach, width in (((10 + 24 / 60) / 12, 0.5, 8), (24 / 60, 0.74, 5)):
        turn = angle * 2 * math.pi
        pen.line(
            (half, half, half + reach * half * math.sin(turn), half - reach * half * math.cos(turn)),
            fill=(30, 40, 44),
            width=width,
        )
    pen.ellipse((half - 7, half - 7, half + 7, half + 7), fill=(190, 60, 50))
    return jpeg(picture)


def outside(size: tuple[int, int] = (1024, 512)) -> bytes:
    """What is seen through a window: hills in the haze of a morning."""
    width, height = size
    y, x = np.mgrid[0:height, 0:width].astype(float)
    sky = y[..., None] / height * np.array([238, 236, 224]) + (1 - y[..., None] / height) * np.array(
        [164, 198, 220]
    )
    picture = sky
    for index in range(5):
        far = 1 - index / 4
        crest = height * (0.5 + 0.085 * index) + sum(
            height
            * 0.05
            * (0.6 + 0.4 * index)
            / k
            * np.sin(x / width * 6.3 * k * (0.6 + 0.25 * index) + 1.7 * index * k)
            for k in (1, 2, 3, 5)
        )
        colour = far * np.array([176, 198, 206]) + (1 - far) * np.array([74, 108, 84])
        soft = 1 / (1 + np.exp(-(y - crest) / 1.2))[..., None]
        haze = np.clip((y - crest) / (height * 0.4), 0, 1)[..., None]
        picture = picture * (1 - soft) + soft * (colour + haze * (np.array([205, 215, 210]) - colour) * 0.35)
    return jpeg(Image.fromarray(np.clip(picture, 0, 255).astype(np.uint8)), 85)
