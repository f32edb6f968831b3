"""Writes one sample as a .blend file, for artists and for looking closer at what was rendered."""

from pathlib import Path

from facegen.conventions import BLOCK
from facegen.errors import InputError
from facegen.files import output_errors, whole_file
from facegen.sampling import draw_samples
from facegen.store import Dataset, licences_of_sources
from facegen.work.worker import draw_render_seed, label_sample


def save_blend(dataset: Dataset, number: int, path: Path, *, view: str | None = None) -> None:
    """Write sample ``number`` of a dataset, rendered or not, as Blender has it when it renders ``view``.

    Parameters
    ----------
    dataset
        Its spec, rig and headset; the folder need not exist.
    number
        Sample.
    path
        The file; it appears whole.
    view
        Name of the camera that is active and whose LEDs are lit; without, the headset's first.

    Raises
    ------
    InputError
        If the sample or the view does not exist, or ``path`` is a folder.
    OutputError
        If the file cannot be written.
    """
    views = dataset.headset.camera_names
    view = views[0] if view is None else view
    if view not in views:
        raise InputError(
            f"headset {dataset.headset.name!r} has no camera {view!r}; it has {', '.join(views)}"
        )
    if not 0 <= number < dataset.plan.samples:
        raise InputError(
            f"sample {number} does not exist; this dataset has samples 0-{dataset.plan.samples - 1}"
        )
    from facegen.blender import open_renderer

    spec, render = dataset.spec, dataset.spec.render
    labelled = label_sample(
        dataset, number, draw_samples(dataset.plan, dataset.rig_of(number), number // BLOCK)
    )
    seed = draw_render_seed(spec.seed, view, number)
    with output_errors(path):
        path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path, suffix=".blend") as part:
        open_renderer(subsurface=render.subsurface).save(
            labelled.sample.scene,
            view,
            part.absolute(),
            samples=render.samples_per_pixel,
            seed=seed,
            denoise=render.denoise,
            licences=licences_of_sources(dataset),
        )
