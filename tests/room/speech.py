"""Makes a film's sound for fake microphones: something like a voice, in bursts with silence between."""

import wave
from pathlib import Path

import numpy as np

RATE = 48_000
VOICED_S, SILENT_S = 1.2, 1.8


def write_bursts(path: Path) -> None:
    """A 16-bit WAV of one burst of two vowels at 140 Hz and one silence, which a browser repeats."""
    time = np.arange(int(RATE * VOICED_S)) / RATE
    pitch = 140 + 15 * np.sin(2 * np.pi * 2.5 * time)
    phase = np.cumsum(pitch) / RATE
    formants = np.where(np.sin(2 * np.pi * 2.5 * time)[:, None] > 0, [700, 1200, 2600], [350, 2000, 2800])
    sound = np.zeros_like(time)
    for harmonic in range(1, 25):
        distance = (harmonic * pitch[:, None] - formants) / [90, 130, 200]
        sound += (1 / (1 + distance**2)).sum(axis=1) * np.sin(2 * np.pi * harmonic * phase)
    sound *= (0.6 + 0.4 * np.sin(2 * np.pi * 5 * time)) * np.minimum(1, np.minimum(time, time[::-1]) / 0.02)
    whole = np.concatenate([sound / np.abs(sound).max() * 0.5, np.zeros(int(RATE * SILENT_S))])
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE)
        file.writeframes((whole * 32767).astype("<i2").tobytes())
