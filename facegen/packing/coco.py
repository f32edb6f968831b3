"""Packs COCO keypoints JSON, one file a view; images are the dataset's own PNG files, named below its folder."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from facegen.formats.coco import LabelledImage, write_coco
from facegen.packing.plan import Options, PackFile, PackFormat
from facegen.packing.rendered import chosen_views, read_rendered
from facegen.store import Dataset, read_description


def view_parts(dataset: Dataset, samples: Sequence[int], options: Options) -> list[PackFile]:
    """One file a view."""
    views = chosen_views(dataset, options)
    return [PackFile(name=f"keypoints-{view}.json", samples=samples, view=view) for view in views]


def write_view(dataset: Dataset, part: PackFile, _options: Options, path: Path) -> None:
    """Write one view's file, one sample in memory at a time."""

    def images() -> Iterator[LabelledImage]:
        for sample in read_rendered(dataset, part.samples, ()):
            view = sample.record["views"][part.view]
            picture = (
                dataset.folder.render(sample.number).relative_to(dataset.folder.path) / f"{part.view}.png"
            )
            yield LabelledImage(
                number=sample.number,
                file_name=picture.as_posix(),
                width=view["camera"]["width"],
                height=view["camera"]["height"],
                points=np.array(view["points_2d"], np.float64),
                visibility=np.array(view["visibility"]),
            )

    described = read_description(dataset.folder)
    about = f"facegen dataset {dataset.hash}, camera {part.view} of headset {dataset.headset.name}"
    info = {"description": about, "version": described["versions"].get("facegen", "unknown")}
    write_coco(path, images, info=info, licence=described["licence"])


COCO = PackFormat(
    description="COCO keypoints JSON, one file a view; images stay in the dataset",
    rendered=True,
    options=frozenset({"views"}),
    shard_size=0,
    parts=view_parts,
    write=write_view,
    version=2,  # boxes of the first began half a pixel off, and its text was not ASCII alone
)
