"""Defines ``facegen preview``."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from facegen.console import progress
from facegen.errors import InputError

if TYPE_CHECKING:
    from facegen.preview import Performance

STRIP = ".png"
PIPE = Path("-")
PAGE = ".html"

_TAKEN = {
    "--weights": ("rig", "fps", "frames", "size", "landmarks"),
    "--clip": ("clip", "frames", "size", "landmarks"),
    "a page of statistics": (),
    "a contact sheet": ("samples", "columns", "landmarks"),
}
"""Options that each kind of picture takes, of those that not all take."""


def preview(
    context: typer.Context,
    dataset: Annotated[Path | None, typer.Argument(help="Folder of a dataset.")] = None,
    out: Annotated[
        Path,
        typer.Option(
            "--out",
            help="File to write: PNG; of clips and weights also .webm, .mp4, .gif or .webp, or - for PPM pictures on "
            "standard output; .html for statistics.",
        ),
    ] = Path("contact-sheet.png"),
    samples: Annotated[
        str | None,
        typer.Option("--samples", help="Samples to show: 0-3,17. Default: the first rendered ones."),
    ] = None,
    columns: Annotated[int, typer.Option("--columns", min=1, max=8, help="Samples side by side.")] = 2,
    landmarks: Annotated[
        bool, typer.Option("--landmarks/--no-landmarks", help="Draw landmarks over the pictures.")
    ] = True,
    clip: Annotated[int | None, typer.Option("--clip", min=0, help="Show this clip of a dataset.")] = None,
    weights: Annotated[
        Path | None,
        typer.Option("--weights", help="Play a CSV of 52 weights: Live Link Face, or regress predict."),
    ] = None,
    rig: Annotated[str, typer.Option("--rig", help="Rig that plays --weights.")] = "anny",
    fps: Annotated[
        float | None,
        typer.Option("--fps", min=1, max=240, help="Rows a second of --weights; default: its own."),
    ] = None,
    frames: Annotated[
        str | None, typer.Option("--frames", help="Frames of the clip or the CSV: 0-299. Default: all.")
    ] = None,
    size: Annotated[int, typer.Option("--size", min=64, max=2160, help="Height of a face in pixels.")] = 480,
) -> None:
    """Draw a contact sheet of samples, or play a clip or a CSV of weights as a strip (PNG) or a film.

    The sheet shows the headset's views with landmarks, the keypoints, and the largest weights of each sample. An HTML
    file holds the whole dataset's statistics instead: weights, what goes together, heads, poses.

    Examples: facegen preview datasets/out/tiny --out tiny.png

    facegen preview datasets/out/default --out statistics.html

    facegen preview datasets/out/protocol --clip 74 --out sentence.webm

    facegen preview --weights take.csv --rig anny --out face.webm
    """
    if (dataset is None) == (weights is None):
        raise InputError(
            "preview shows either the folder of a dataset or --weights FILE.csv; give one of them"
        )
    _check_name(out, moving=weights is not None or clip is not None)
    page = out.suffix.lower() == PAGE
    still = "a page of statistics" if page else "a contact sheet"
    _refuse_useless(context, "--weights" if weights is not None else still if clip is None else "--clip")
    if weights is not None:
        from facegen.formats.weight_table import read_weight_table
        from facegen.preview import play_weights
        from facegen.rigs import load_rig

        table, time_s = read_weight_table(weights, fps=fps)
        _play(play_weights(load_rig(rig), table, time_s, title=weights.name), out, frames, size, landmarks)
    elif clip is not None:
        from facegen.preview import clip_of_dataset
        from facegen.store import open_dataset

        _play(clip_of_dataset(open_dataset(dataset), clip), out, frames, size, landmarks)
    elif page:
        _statistics(dataset, out)
    else:
        _sheet(dataset, out, samples, columns, landmarks)
    if out != PIPE:
        print(out)


def _refuse_useless(context: typer.Context, shown: str) -> None:
    """Refuse options that what is shown does not take: it would look as if they had been followed."""
    for name in dict.fromkeys(name for names in _TAKEN.values() for name in names):
        source = context.get_parameter_source(name)
        if name not in _TAKEN[shown] and source is not None and source.name == "COMMANDLINE":
            flags = next(
                each.opts + each.secondary_opts for each in context.command.params if each.name == name
            )
            raise InputError(f"{shown} takes no {' or '.join(flags)}; leave that out")


def _check_name(out: Path, *, moving: bool) -> None:
    """Refuse a name that promises another kind of file, before anything is read."""
    from facegen.preview import ANIMATION_SUFFIXES, FILM_SUFFIXES, SHEETS

    suffixes = (STRIP, *FILM_SUFFIXES, *ANIMATION_SUFFIXES) if moving else (*SHEETS, PAGE)
    if out.suffix.lower() not in suffixes and not (moving and out == PIPE):
        hint = "" if moving else "; for a film name a clip with --clip"
        raise InputError(f"--out: {out} ends in none of {', '.join(suffixes)}{hint}")


def _play(performance: "Performance", out: Path, frames: str | None, height_px: int, landmarks: bool) -> None:
    """Write a strip, a film, or pictures to standard output."""
    from facegen.files import whole_file
    from facegen.formats.ppm import ppm_bytes
    from facegen.preview import clip_strip, pictures, write_film
    from facegen.spec import sample_numbers

    if frames is not None:
        total = len(performance.time_s)
        performance = performance.rows(sample_numbers(frames, total=total, where="--frames", what="frame"))
    if out.suffix.lower() == STRIP:
        figure = clip_strip(performance, height_px=height_px, landmarks=landmarks)
        with whole_file(out) as part:
            figure.savefig(part)
        return
    with progress() as show:

        def counted():
            for done, picture in enumerate(pictures(performance, height_px=height_px, landmarks=landmarks)):
                yield picture
                show("frames", done + 1, len(performance.time_s))

        if out == PIPE:
            for picture in counted():
                sys.stdout.buffer.write(ppm_bytes(picture))
            sys.stdout.buffer.flush()
            return
        with whole_file(out) as part:
            write_film(part, counted(), fps=performance.fps)


def _statistics(dataset: Path, out: Path) -> None:
    """Write the page of statistics."""
    from facegen.files import whole_file
    from facegen.preview import dataset_statistics, statistics_page
    from facegen.store import open_dataset

    opened = open_dataset(dataset)
    text = statistics_page(opened, dataset_statistics(opened))
    with whole_file(out) as part:
        part.write_text(text, encoding="utf-8")


def _sheet(dataset: Path, out: Path, samples: str | None, columns: int, landmarks: bool) -> None:
    """Write a contact sheet."""
    from facegen.conventions import SHARD_ROWS
    from facegen.files import whole_file
    from facegen.preview import contact_sheet
    from facegen.spec import sample_numbers
    from facegen.store import open_dataset, shard_samples

    opened = open_dataset(dataset)
    # a shard that is there is whole, so nothing is read to know what has been made
    shards = {int(path.stem.removeprefix("shard-")) for path in opened.made_shards()}
    if samples is not None:
        numbers = sample_numbers(samples, total=opened.plan.samples, where="--samples")
    else:
        numbers = opened.folder.rendered()[:8] or shard_samples(min(shards), total=opened.plan.samples)[:8]
    missing = sorted(number for number in numbers if number // SHARD_ROWS not in shards)
    if missing or not numbers:
        raise InputError(
            f"{dataset}: sample {missing[0] if missing else 0} has not been made; run facegen generate first"
        )
    figure = contact_sheet(opened, numbers, columns=columns, landmarks=landmarks)
    with whole_file(out) as part:
        figure.savefig(part, facecolor=figure.get_facecolor())
