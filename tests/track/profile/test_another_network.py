"""A headset's profile with another network: nothing that the former one read, and no placement of its view."""

from dataclasses import replace

import numpy as np
import pytest

from regress.runtime.headset.person.person import OwnEye
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.sample import Sample
from track.cli.opening import Wishes
from track.cli.opening_profile import open_profile
from track.profile.neutral import NeutralFace
from track.profile.profile import ModelMark, Profile, write_profile
from track.session.calibration import Outcome
from track.session.headset import HeadsetPipeline
from track.session.outcomes import learnt

FORMER = ModelMark(kind="headset", sha256="ab" * 32)
NEUTRAL = NeutralFace(pictures={"left_eye": "AAAA"})
PLACED = {"placement": {"left_eye": CameraPlacement(size=0.8)}}
READ = {"ranges": {"jawOpen": 0.6}, "eyes": {"left_eye": OwnEye(rest_mm=9.0, shut_mm=1.0)}}


def pipeline_of(model: str) -> HeadsetPipeline:
    return HeadsetPipeline(model, filter_name="none")


def opened(tmp_path, pipeline: HeadsetPipeline, mark: ModelMark, *, given=None, **known):
    """The profile as the pipeline uses it, and what is said."""
    path = write_profile(
        tmp_path / "me.toml",
        Profile(person="me", camera="three", model=mark, neutral=NEUTRAL, **known),
    )
    said: list[str] = []
    wishes = Wishes(profile=str(path), placement=given)
    used, stored, _ = open_profile(wishes, pipeline, {"left_eye": "left"}, said.append)
    assert stored.placement == known.get("placement", {})
    return used, said


def test_a_placement_and_lids_of_another_network_are_left_out_and_told(tmp_path):
    """`headset-any` began as `headset-tracking3`, and sees other headsets."""
    mark = pipeline_of("headset-tracking3").mark
    used, said = opened(tmp_path, pipeline_of("headset-any"), mark, **PLACED, **READ)
    assert used.placement == used.eyes == used.ranges == {}
    assert used.neutral is None, "it was seen through the placement"
    assert sum("its ranges and lids were read by another model" in each for each in said) == 1
    assert sum("its placement was found with another network" in each for each in said) == 1


def test_a_neutral_face_that_was_not_placed_stays(tmp_path):
    used, said = opened(tmp_path, pipeline_of("headset-tracking3"), FORMER, eyes=READ["eyes"])
    assert (used.neutral, used.eyes) == (NEUTRAL, {})
    assert [each.partition(": ")[2] for each in said] == [
        "its lids were read by another model and are left out; calibrate again"
    ]


def test_an_adapted_network_keeps_the_placement_and_reads_lids_itself(tmp_path):
    pipeline = pipeline_of("headset-tracking3")
    model = pipeline._predictor.model
    training = replace(model.training, adapted_from=(FORMER.sha256,))
    pipeline._predictor = replace(pipeline._predictor, model=replace(model, training=training))
    used, said = opened(tmp_path, pipeline, FORMER, **PLACED, **READ)
    assert (used.placement, used.neutral, used.eyes) == (PLACED["placement"], NEUTRAL, {})
    assert not any("placement" in each for each in said)


def test_a_placement_that_is_given_goes_before(tmp_path):
    path = tmp_path / "placement.toml"
    path.write_text("version = 1\n[cameras.mouth]\nsize = 0.9\n")
    used, _ = opened(tmp_path, pipeline_of("headset-tracking3"), FORMER, given=path, **PLACED)
    assert used.placement == {"mouth": CameraPlacement(size=0.9)}


@pytest.mark.parametrize(
    ("text", "stays"),
    [
        ("size = 0.8\nlow = 25.0\nhigh = 180.0", True),
        ("size = 0.9", False),
        ("size = 0.8\nmirror = true", False),
    ],
)
def test_a_neutral_face_stays_where_the_same_part_of_pictures_is_seen(tmp_path, text: str, stays: bool):
    path = tmp_path / "placement.toml"
    path.write_text(f"version = 1\n[cameras.left_eye]\n{text}\n")
    pipeline = pipeline_of("headset-tracking3")
    used, said = opened(tmp_path, pipeline, pipeline.mark, given=path, **PLACED, **READ)
    assert (used.neutral, used.ranges) == ((NEUTRAL, READ["ranges"]) if stays else (None, {}))
    assert any("seen through another placement" in each for each in said) != stays


@pytest.mark.parametrize("name", ["look_around", "smile"])
def test_each_face_says_which_network_read_it(name):
    """A profile that does not say so would keep its placement with any."""
    pipeline = pipeline_of("headset-tracking3")
    samples = tuple(Sample(weights=np.zeros(52), gaze=np.zeros(4)) for _ in range(3))
    found = learnt(
        Outcome(name=name, samples=samples, ranges={}), Profile(person="me", camera="three"), pipeline
    )
    assert found["model"] == pipeline.mark
