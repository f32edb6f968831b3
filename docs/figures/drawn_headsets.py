"""Draws docs/pictures/drawn-headsets.webp: one person's face as the ten drawn headsets of headset-any-test.toml see it.

    python docs/figures/drawn_headsets.py

A column is a headset, its rows are the right eye, the left eye and the mouth.
"""

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from facegen.blender import open_renderer
from facegen.labels import label_rendered, with_glints
from facegen.sampling import draw_samples
from facegen.sensor import develop_view
from facegen.sessions import draw_sample_scene, drawn_headset
from facegen.spec import load_spec
from facegen.store import resolve

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "docs" / "pictures" / "drawn-headsets.webp"
SIDE_PX, PATHS = 144, 16
SAMPLE = 62
"""Of the spec: an expression with a smile and open eyes."""
ORDER = ("right_eye", "left_eye", "mouth")


def main() -> None:
    """Render the sheet."""
    spec = load_spec(ROOT / "datasets" / "headset-any-test.toml")
    dataset = resolve(replace(spec, render=replace(spec.render, size_px=SIDE_PX)), OUT.parent)
    row = draw_samples(dataset.plan, dataset.rig, 0).rows(slice(SAMPLE, SAMPLE + 1))
    renderer = open_renderer(threads=2, subsurface=True)
    columns = []
    for number in range(spec.layout.count):
        worn = drawn_headset(spec, dataset.rig, dataset.headset, number)
        alone = replace(spec, layout=None)
        labelled = label_rendered(alone, dataset.rig, draw_sample_scene(alone, dataset.rig, worn, row))
        sample = labelled.sample
        pictures = {}
        for view in sample.scene.views:
            layers = renderer.glimpse(sample.scene, view.name, samples=PATHS, seed=1, denoise=True)
            layers = replace(layers, radiance=with_glints(layers.radiance, labelled.views[view.name].glints))
            unit = sample.session.unit
            pictures[view.name] = develop_view(
                layers, unit.camera(view.name), view.camera_from_head, unit.sensor, sample.shots[view.name]
            )
        columns.append(np.vstack([pictures[name] for name in ORDER]))
    cv2.imwrite(str(OUT), np.hstack(columns), [cv2.IMWRITE_WEBP_QUALITY, 85])


if __name__ == "__main__":
    main()
