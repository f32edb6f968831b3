"""Labels: what is known of a sample because it was made, not looked at."""

from facegen.labels.eye_outlines import EyeOutlines
from facegen.labels.glints import Glints
from facegen.labels.keypoints import KEYPOINT_LABELS, Keypoints, further_columns, label_keypoints
from facegen.labels.rendered import RenderedSample, label_rendered
from facegen.labels.spots import with_glints
from facegen.labels.views import VIEW_LABEL_KEYS, ViewLabels

__all__ = [
    "KEYPOINT_LABELS",
    "VIEW_LABEL_KEYS",
    "EyeOutlines",
    "Glints",
    "Keypoints",
    "RenderedSample",
    "ViewLabels",
    "further_columns",
    "label_keypoints",
    "label_rendered",
    "with_glints",
]
