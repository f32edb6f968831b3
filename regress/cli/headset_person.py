"""What `regress headset predict` knows of a person: the file of `regress headset calibrate`."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from facegen.console import say
from regress.errors import InputError

if TYPE_CHECKING:
    from regress.runtime.headset.network.predictor import HeadsetPredictor
    from regress.runtime.headset.person.neutral import Neutral
    from regress.runtime.headset.person.person import Person
    from regress.runtime.headset.pictures.placement import CameraPlacement
    from regress.runtime.headset.placing.levels import CameraLevels
    from regress.runtime.headset.recordings.footage import Footage


def read_own(predictor: "HeadsetPredictor", path: Path | None, *, still: bool) -> "Person | None":
    """A person's file, where one is named, it is of this network and the footage is of one person.

    Raises
    ------
    InputError
        Where it is not.
    """
    from regress.runtime.headset.person.person import read_person

    if path is None:
        return None
    person = read_person(path)
    if still:
        raise InputError("a dataset has many people, and --person is for a recording of one")
    if person.network_sha256 != predictor.model.network_sha256:
        raise InputError(
            f"{path} was calibrated with another network than this model's; `regress headset calibrate` again"
        )
    strangers = [name for name in (*person.eyes, *person.neutral) if name not in predictor.sizes]
    if strangers:
        raise InputError(
            f"{path}: the model has no camera {strangers[0][:60]!r}; it has {', '.join(predictor.sizes)}"
        )
    looked = any(eye.traced is not None or eye.direct is not None for eye in person.eyes.values())
    if person.version == 1 and predictor.model.of_many_headsets and looked:
        say(
            f"{path} was made by an older version, and its gaze does not count: `regress headset calibrate` again"
        )
        return person.without_gaze()
    return person


def tell_of_views(
    person: "Person | None",
    places: "Mapping[str, CameraPlacement]",
    predictor: "HeadsetPredictor",
    path: Path | None,
) -> None:
    """Say where a person was calibrated through other views, or with other words of the cameras, than these."""
    from regress.runtime.headset.person.person import seen_as

    if person is not None and person.seen_as not in (None, seen_as(places, predictor.graph.told_table)):
        say(
            f"{path} was made with another --placement or --headset, so its neutral pictures and lids do not fit: give "
            "the same, or calibrate again"
        )


def neutrals_of(
    person: "Person | None",
    predictor: "HeadsetPredictor",
    footage: "Footage",
    levels: "Mapping[str, CameraLevels]",
) -> "list[Neutral]":
    """The neutral pictures of a person's file; none without one, or where a camera in use has none there."""
    if person is None or not person.neutral:
        return []
    from regress.runtime.headset.person.neutral import Neutral
    from regress.runtime.headset.person.person import unpacked_picture

    used = [name for name, there in zip(footage.cameras, footage.given, strict=True) if there]
    lacking = [name for name in used if name not in person.neutral]
    if lacking:
        say(f"the person's file has no neutral picture of {', '.join(lacking)}: frames are seen alone")
        return []
    pictures = {}
    for name in used:
        width, height = predictor.sizes[name]
        picture = unpacked_picture(person.neutral[name], width=width, height=height, of=f"{name} of --person")
        pictures[name] = levels[name].apply(picture) if name in levels else picture
    return [Neutral(row=0, pictures=pictures)]
