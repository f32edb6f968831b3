"""Lists the labels of a rendered view; ``sample.json``, packs, checks and docs/labels.md follow from this list."""

from dataclasses import dataclass, fields

from facegen.labels.eye_outlines import ViewOutlines
from facegen.labels.glints import Glints
from facegen.labels.view_eyes import ViewEyes
from facegen.labels.view_label import LabelKey, ViewLabel
from facegen.labels.view_landmarks import ViewLandmarks
from facegen.rigs import Rig
from facegen.sessions import SampleScene


@dataclass(frozen=True, kw_only=True, eq=False)
class ViewLabels:
    """Every label of a view; a new one is a module (`facegen.labels.view_label.ViewLabel`) and a line here."""

    landmarks: ViewLandmarks
    eyes: ViewEyes
    outlines: ViewOutlines
    glints: Glints

    def record(self) -> dict:
        """All keys of all labels, as a view in ``sample.json`` has them."""
        return {
            key: value for name in VIEW_LABEL_TYPES for key, value in getattr(self, name).record().items()
        }


VIEW_LABEL_TYPES: dict[str, type[ViewLabel]] = {field.name: field.type for field in fields(ViewLabels)}
VIEW_LABEL_KEYS: tuple[LabelKey, ...] = tuple(key for kind in VIEW_LABEL_TYPES.values() for key in kind.KEYS)


def label_views(rig: Rig, sample: SampleScene) -> dict[str, ViewLabels]:
    """Make all labels of all views of a sample, by camera name."""
    made = {name: kind.of_sample(rig, sample) for name, kind in VIEW_LABEL_TYPES.items()}
    return {
        view.name: ViewLabels(**{name: by_view[view.name] for name, by_view in made.items()})
        for view in sample.scene.views
    }
