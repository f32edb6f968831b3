"""Pictures of datasets for people to look at."""

from facegen.preview.films import ANIMATIONS, FILMS, clip_strip, write_film
from facegen.preview.performance import Performance, clip_of_dataset, pictures, play_weights
from facegen.preview.sheet import contact_sheet

__all__ = [
    "ANIMATIONS",
    "FILMS",
    "Performance",
    "clip_of_dataset",
    "clip_strip",
    "contact_sheet",
    "pictures",
    "play_weights",
    "write_film",
]
