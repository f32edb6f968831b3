"""Pictures of datasets for people to look at."""

from facegen.preview.films import ANIMATION_SUFFIXES, FILM_SUFFIXES, clip_strip, write_film
from facegen.preview.performance import Performance, clip_of_dataset, pictures, play_weights
from facegen.preview.sheet import SHEETS, contact_sheet
from facegen.preview.statistics import Statistics, dataset_statistics
from facegen.preview.statistics_page import statistics_page

__all__ = [
    "ANIMATION_SUFFIXES",
    "FILM_SUFFIXES",
    "SHEETS",
    "Performance",
    "Statistics",
    "clip_of_dataset",
    "clip_strip",
    "contact_sheet",
    "dataset_statistics",
    "pictures",
    "play_weights",
    "statistics_page",
    "write_film",
]
