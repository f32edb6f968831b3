"""Labels a sample's scene: keypoints, lids and every view, before it is rendered."""

from dataclasses import dataclass

import numpy as np

from facegen.labels.keypoints import Keypoints, label_keypoints
from facegen.labels.views import ViewLabels, label_views
from facegen.rigs import Rig, lid_gap, open_lid_gap
from facegen.sessions import SampleScene
from facegen.spec import Spec


@dataclass(frozen=True, kw_only=True, eq=False)
class RenderedSample:
    """Everything of one sample that a renderer does not add.

    Attributes
    ----------
    sample
        Session, shots, face and scene.
    keypoints
        One row.
    lid_gap_m, openness
        (2,) how far the lids of each eye stand apart (`facegen.rigs.lid_gap`), and the share that this is of the same
        person's neutral face looking straight ahead; 0 is closed, wide eyes have more than 1.
    views
        Labels by camera name.
    """

    sample: SampleScene
    keypoints: Keypoints
    lid_gap_m: np.ndarray
    openness: np.ndarray
    views: dict[str, ViewLabels]


def label_rendered(spec: Spec, rig: Rig, sample: SampleScene) -> RenderedSample:
    """Label the scene of one sample."""
    gap = lid_gap(rig, sample.face.vertices[0])
    return RenderedSample(
        sample=sample,
        keypoints=label_keypoints(spec, rig, sample.row, sample.face),
        lid_gap_m=gap,
        openness=_share(gap, open_lid_gap(rig, tuple(sample.row.identity[0].tolist()))),
        views=label_views(rig, sample),
    )


def _share(gap: np.ndarray, open_gap: np.ndarray) -> np.ndarray:
    """Gaps (2,) as shares of those of open eyes; 0 for eyes whose lids touch at rest, as they may on a user's head."""
    return np.divide(gap, open_gap, out=np.zeros_like(gap), where=open_gap > 0)
