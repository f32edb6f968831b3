"""Labels: what is known of a sample because it was made, not looked at."""

from facegen.labels.eye_outlines import EyeOutlines
from facegen.labels.glints import Glints
from facegen.labels.keypoints import Keypoints, label_keypoints, project_pinhole
from facegen.labels.rendered import RenderedSample, label_rendered, session_unit
from facegen.labels.spots import with_glints
from facegen.labels.views import ViewLabels

__all__ = [
    "EyeOutlines",
    "Glints",
    "Keypoints",
    "RenderedSample",
    "ViewLabels",
    "label_keypoints",
    "label_rendered",
    "project_pinhole",
    "session_unit",
    "with_glints",
]
