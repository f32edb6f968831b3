"""Makes pictures anew from the radiance of a rendered dataset, with another sensor or other draws (``develop``)."""

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from facegen.errors import FormatError, InputError, InvalidData
from facegen.files import output_errors
from facegen.formats.litter import is_litter
from facegen.sampling import Shot, draw_shot
from facegen.sensor import develop_view
from facegen.sessions import draw_unit_of_session
from facegen.store import (
    Dataset,
    DatasetFolder,
    commit_file,
    commit_folder,
    licences,
    png_bytes,
    put_licences,
    read_exr,
    read_json,
    staging,
    sweep,
    write_json,
)

SETTINGS_FILE = "develop.json"
"""What the pictures of a folder were developed with; a folder holds one setting."""


@dataclass(frozen=True, kw_only=True)
class Settings:
    """Differences from the dataset's own pictures; None leaves a value as it is.

    Attributes
    ----------
    exposure, gain
        Instead of the headset's (`facegen.headsets.HeadsetSensor`); units still differ by its tolerances.
    noise
        Factor on shot and read noise, instead of the spec's.
    seed
        Of the draws of exposure, motion, noise, room and flash, instead of the spec's.
    """

    exposure: float | None = None
    gain: float | None = None
    noise: float | None = None
    seed: int | None = None


def develop_dataset(
    dataset: Dataset,
    out: Path,
    settings: Settings = Settings(),
    numbers: list[int] | None = None,
    *,
    on_progress: Callable[[int], None] = lambda done: None,
) -> int:
    """Develop rendered samples into ``out``, laid out as a dataset's ``renders``; returns how many were made.

    What is there already is kept, so a second run goes on. Beside the pictures of each sample, ``shots.json`` holds
    its shots as `facegen.store.sample_record` has them, and ``LICENSE.txt`` beside all is as the dataset's.

    Raises
    ------
    InputError
        If the dataset keeps no radiance, a sample has not been rendered, or ``out`` holds pictures of another dataset
        or of other settings.
    """
    if not dataset.spec.render.truth:
        raise InputError(
            f"{dataset.folder.path}: has no EXR files and so no radiance to develop, because its spec says "
            f"render.truth = false; make it anew with true"
        )
    rendered = set(dataset.folder.rendered())
    numbers = sorted(rendered) if numbers is None else numbers
    missing = sorted(set(numbers) - rendered)
    if missing or not numbers:
        raise InputError(
            f"{dataset.folder.path}: sample {missing[0] if missing else 0} has not been rendered; run facegen generate "
            f"first"
        )
    _begin(dataset, out, settings)
    folder, made = DatasetFolder(out), 0
    sweep(folder)
    put_licences(licences(dataset), folder)
    for done, number in enumerate(numbers):
        on_progress(done)
        if folder.render(number).exists():
            continue
        pictures, shots = develop_sample(dataset, number, settings)
        with staging(folder, f"develop-{number}") as stage:
            for view, grey in pictures.items():
                (stage / f"{view}.png").write_bytes(png_bytes(grey))
            write_json(stage / "shots.json", {view: asdict(shot) for view, shot in shots.items()})
            made += commit_folder(stage, folder.render(number))
    on_progress(len(numbers))
    return made


def develop_sample(
    dataset: Dataset, number: int, settings: Settings = Settings()
) -> tuple[dict[str, np.ndarray], dict[str, Shot]]:
    """Grey pictures (h, w) uint8 and shots of one rendered sample by view.

    With the plain settings the pictures are the dataset's own. LEDs stay as they were rendered.
    """
    spec, record = dataset.spec, dataset.sample(number)
    changes = {
        key: getattr(settings, key) for key in ("exposure", "gain") if getattr(settings, key) is not None
    }
    headset = replace(dataset.headset, sensor=replace(dataset.headset.sensor, **changes))
    rig = dataset.rig_of(number)
    unit = draw_unit_of_session(spec, rig, headset, person=record["person"], session=record["session"])
    pictures, shots = {}, {}
    for camera in unit.cameras:
        view = camera.name
        leds = tuple(led.name for led in unit.leds if led.camera == view)
        place = {"session": record["session"], "sample": number}
        rendered = draw_shot(spec, view, leds, **place)
        shot = draw_shot(spec, view, leds, **place, seed=settings.seed)
        noise = shot.noise if settings.noise is None else settings.noise
        shots[view] = replace(shot, noise=noise, dropped_led=rendered.dropped_led)
        path = dataset.folder.render(number) / f"{view}.exr"
        try:
            layers = read_exr(path)
        except FormatError as error:  # others are there already: not the input is bad, but this sample
            raise InvalidData(f"{error}; run facegen validate --repair, then facegen generate") from None
        if layers.radiance.shape != (camera.height, camera.width):
            raise InvalidData(
                f"{path}: has {layers.radiance.shape[1]} x {layers.radiance.shape[0]} pixels, but camera {view!r} has "
                f"{camera.width} x {camera.height}; run facegen validate --repair, then facegen generate"
            )
        camera_from_head = np.array(record["views"][view]["camera_from_head"])
        pictures[view] = develop_view(layers, camera, camera_from_head, unit.sensor, shots[view])
    return pictures, shots


def _begin(dataset: Dataset, out: Path, settings: Settings) -> None:
    """Write what the folder's pictures are; check what an old one holds."""
    path, content = out / SETTINGS_FILE, {"spec_hash": dataset.hash, "settings": asdict(settings)}
    if path.is_file():
        if read_json(path) != content:
            raise InputError(
                f"{out}: holds pictures of another dataset or with other settings ({SETTINGS_FILE} says which); choose "
                f"another folder"
            )
        return
    with output_errors(out):
        if out.is_dir() and any(p.name != "tmp" and not is_litter(p.name) for p in out.iterdir()):
            raise InputError(f"{out}: is not empty and holds no developed pictures; choose another folder")
        out.mkdir(parents=True, exist_ok=True)
    with staging(DatasetFolder(out), "begin") as stage:
        write_json(stage / SETTINGS_FILE, content)
        commit_file(stage / SETTINGS_FILE, path)
