"""``regress headset check`` names what was done to rendered frames and places them for `predict`."""

import json
import tracemalloc
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from regress.errors import InputError
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.fitness.both_eyes import _are_the_same
from regress.runtime.headset.fitness.fitness import judge
from regress.runtime.headset.fitness.misfits import Misfit
from regress.runtime.headset.fitness.sheet import fitness_sheet
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.pictures.looks import flicker_of
from regress.runtime.headset.pictures.placement import CameraPlacement, whole_view
from regress.runtime.headset.placing.found_placement import FoundPlacement
from regress.runtime.headset.placing.placement_file import read_placement
from regress.runtime.headset.placing.placement_search import find_placement
from regress.runtime.headset.placing.placement_steps import (
    Search,
    _apart,
    _is_as_drawn,
    _moved,
    placement_of_points,
)
from tests.regress.headset.takes import write_take
from tests.regress.headset.tiny import write_tiny_model

pytestmark = pytest.mark.slow

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
EYES = ("left_eye", "right_eye")


@pytest.fixture(scope="module")
def take() -> dict[str, np.ndarray]:
    """A rendered person's frames, of whom the model has learned nothing."""
    return {
        name: np.stack(
            [cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in sorted((TAKE / name).glob("*.png"))]
        )
        for name in EYES
    }


@pytest.fixture(scope="module")
def predictor() -> HeadsetPredictor:
    return load_headset_predictor("headset-tracking3")


def in_a_circle(pictures: np.ndarray) -> np.ndarray:
    rows, columns = np.mgrid[: pictures.shape[1], : pictures.shape[2]]
    far = (rows - pictures.shape[1] / 2) ** 2 + (columns - pictures.shape[2] / 2) ** 2 > (
        0.36 * pictures.shape[2]
    ) ** 2
    return np.where(far, 12, pictures).astype(np.uint8)


def brighter(pictures: np.ndarray, factor: float | np.ndarray) -> np.ndarray:
    return np.clip(pictures * factor, 0, 255).astype(np.uint8)


Take = Mapping[str, np.ndarray]
FAULTS: dict[str, tuple[Callable[[Take], Take], Misfit]] = {
    "too dark": (lambda eyes: {"left_eye": brighter(eyes["left_eye"], 0.4)}, Misfit.DARK),
    "clipped": (lambda eyes: {"left_eye": brighter(eyes["left_eye"], 2.6)}, Misfit.CLIPPED),
    "soft": (
        lambda eyes: {"left_eye": np.stack([cv2.GaussianBlur(one, (0, 0), 2.5) for one in eyes["left_eye"]])},
        Misfit.SOFT,
    ),
    "mirrored": (lambda eyes: {"left_eye": eyes["left_eye"][:, :, ::-1]}, Misfit.MIRRORED),
    "upside down": (lambda eyes: {"left_eye": eyes["left_eye"][:, ::-1, ::-1]}, Misfit.UPSIDE_DOWN),
    "on its side": (
        lambda eyes: {"left_eye": np.ascontiguousarray(np.rot90(eyes["left_eye"], axes=(1, 2)))},
        Misfit.SIDEWAYS,
    ),
    "exchanged": (
        lambda eyes: {"left_eye": eyes["right_eye"], "right_eye": eyes["left_eye"]},
        Misfit.EXCHANGED,
    ),
    "other eye": (lambda eyes: dict.fromkeys(EYES, eyes["right_eye"]), Misfit.OTHER),
    "cropped brow": (lambda eyes: {"left_eye": eyes["left_eye"][:, 26:]}, Misfit.BROW),
    "lens circle": (lambda eyes: {"left_eye": in_a_circle(eyes["left_eye"])}, Misfit.RIM),
    "flicker": (
        lambda eyes: {
            "left_eye": brighter(
                eyes["left_eye"], np.where(np.arange(len(eyes["left_eye"])) % 2, 1.0, 0.8)[:, None, None]
            )
        },
        Misfit.FLICKER,
    ),
}
"""What is done to a take that fits, and what has to be said of it."""

BESIDE = {"cropped brow": {Misfit.PLACED}}
"""What may be said as well: a view that is cut above has its middle elsewhere."""


@pytest.mark.parametrize("fault", FAULTS)
def test_each_fault_is_named_and_nothing_else_is(predictor: HeadsetPredictor, take: Take, fault: str):
    done, expected = FAULTS[fault]
    footage = {name: np.ascontiguousarray(pictures) for name, pictures in done(take).items()}
    for one in judge(predictor, footage):
        found = {finding.misfit for finding in one.findings}
        assert expected in found, [finding.sentence for finding in one.findings]
        assert found <= {expected} | BESIDE.get(fault, set())
        for finding in one.findings:
            assert finding.sentence.startswith(one.camera) or expected in (Misfit.EXCHANGED, Misfit.OTHER)
            assert finding.misfit is Misfit.PLACED or finding.misfit.value.split()[-1] in finding.sentence


def test_a_take_that_fits_is_left_as_it_is(predictor: HeadsetPredictor, take: Take):
    (one,) = judge(predictor, {"left_eye": take["left_eye"]})
    assert one.findings == ()
    assert one.placement == CameraPlacement()


def test_the_sheet_shows_a_mean_picture_of_training_where_there_is_one(
    predictor: HeadsetPredictor, take: Take
):
    """`headset-any` has none, and the take's own mean was shown under that name."""
    footage = {"left_eye": take["left_eye"][:20]}
    across = {}
    for model in (predictor, load_headset_predictor("headset-any")):
        sheet = fitness_sheet(model, footage, judge(model, footage))
        drawn = cv2.imdecode(np.frombuffer(sheet, np.uint8), cv2.IMREAD_COLOR)
        across["left_eye" in model.typical] = drawn.shape[1]
    assert across[True] - across[False] == 192 + 4


def test_a_take_that_fits_needs_no_placement(run, take: Take, tmp_path: Path):
    options = write_take(tmp_path, {"left_eye": take["left_eye"]})
    code, _, told = run(
        "headset", "check", "headset-tracking3", *options, "--out", tmp_path / "placement.toml"
    )
    assert code == 0
    assert "so predict needs none" in told


@pytest.mark.parametrize(
    ("size", "x", "y", "roll_deg", "mirror"),
    [(0.8, 0.55, 0.45, 0.0, False), (1.25, 0.5, 0.5, 8.0, False), (0.9, 0.45, 0.55, -8.0, True)],
)
def test_a_crop_is_placed_where_the_uncropped_frames_are(
    predictor: HeadsetPredictor, take: Take, size: float, x: float, y: float, roll_deg: float, mirror: bool
):
    pictures = take["left_eye"]
    plain = find_placement(predictor, "left_eye", pictures).placement
    crop = replace(plain, x=x, y=y, size=size, roll_deg=roll_deg, mirror=mirror)
    width, height = 144, 120
    wide = crop.picture_from_view((96, 96), (width, height))
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    seen = np.stack(
        [
            cv2.warpAffine(one, wide, (width, height), flags=flags, borderMode=cv2.BORDER_REPLICATE)
            for one in pictures
        ]
    )
    found = find_placement(predictor, "left_eye", seen).placement
    assert found.mirror == mirror
    # both lead from the view to the uncropped frames, one through the crop
    through = _square(wide) @ _square(found.picture_from_view((width, height), (96, 96)))
    straight = _square(plain.picture_from_view((96, 96), (96, 96)))
    assert abs(np.log(np.sqrt(np.linalg.det(through[:2, :2]) / np.linalg.det(straight[:2, :2])))) < 0.05
    middle = np.array([47.5, 47.5, 1.0])
    assert np.linalg.norm((through @ middle - straight @ middle)[:2]) < 0.03 * 96


def test_the_side_is_told_by_all_frames_and_not_by_the_few_of_the_steps(take: Take):
    """A third of the frames come upright, those that the steps see; the others come in a mirror."""
    predictor = load_headset_predictor("headset-any")
    pictures = take["left_eye"][:48]
    few = np.linspace(0, 47, 16).round().astype(int)
    seen = np.ascontiguousarray(pictures[:, :, ::-1])
    seen[few] = pictures[few]
    assert find_placement(predictor, "left_eye", seen).placement.mirror
    assert not find_placement(predictor, "left_eye", seen[few]).placement.mirror


@pytest.mark.parametrize("shape", [(72, 96), (96, 72), (96, 96)])
def test_all_of_a_picture_is_all_of_it_also_where_it_stands_upright(
    predictor: HeadsetPredictor, take: Take, monkeypatch: pytest.MonkeyPatch, shape: tuple[int, int]
):
    """A view as wide as the picture cut a quarter off a rotated sensor's, from which the search also began."""
    height, width = shape
    pictures = take["left_eye"][:24, :height, :width]
    starts = []

    def best(self, start: CameraPlacement) -> FoundPlacement:
        starts.append(start)
        return FoundPlacement(placement=replace(start, x=0.0), deviation=0.1, unrest=0.05, unsettled=0.1)

    monkeypatch.setattr(Search, "best", best)
    found = find_placement(predictor, "left_eye", pictures)
    whole = replace(whole_view((width, height), (96, 96)), aspect=None)
    assert found.lost
    assert starts[0] == whole
    assert replace(found.placement, mirror=False) == whole
    matrix = found.placement.picture_from_view((width, height), (96, 96))
    corners = np.array([[-0.5, -0.5], [95.5, 95.5]]) @ matrix[:, :2].T + matrix[:, 2]
    assert (corners.min(axis=0) <= -0.5 + 1e-9).all()
    assert (corners.max(axis=0) >= np.array([width, height]) - 0.5 - 1e-9).all()


def _square(matrix: np.ndarray) -> np.ndarray:
    return np.vstack([matrix, [0, 0, 1]])


def test_the_program_says_it_and_predict_takes_what_it_writes(run, take: Take, tmp_path: Path):
    pictures = take["left_eye"][:40]
    placed = np.pad(pictures[:, :, ::-1], ((0, 0), (0, 24), (0, 40)), mode="edge")
    options = write_take(tmp_path, {"left_eye": placed})
    out, sheet = tmp_path / "placement.toml", tmp_path / "sheet.png"
    code, said, _ = run("headset", "check", "headset-tracking3", *options, "--out", out, "--sheet", sheet)
    assert code == 0
    assert "left_eye is mirrored, or of the other eye" in said
    placement = read_placement(out, load_headset_predictor("headset-tracking3").model)["left_eye"]
    assert placement.mirror
    assert placement.aspect == pytest.approx(136 / 120, abs=1e-3)
    drawn = cv2.imread(str(sheet))
    assert drawn is not None
    assert drawn.std() > 20
    code, said, _ = run("headset", "check", "headset-tracking3", *options, "--json")
    assert json.loads(said)["left_eye"]["findings"][0]["misfit"] == "mirrored"
    # with the placement the mirrored take gives nearly what the plain one gives, without it something else
    answers = {}
    plain = write_take(tmp_path / "plain", {"left_eye": pictures})
    for name, words in (
        ("plain", plain),
        ("placed", [*options, "--placement", out]),
    ):
        table = tmp_path / f"{name}.csv"
        code, _, said = run("headset", "predict", "headset-tracking3", *words, "--out", table)
        assert code == 0, said
        answers[name] = np.genfromtxt(table, delimiter=",", names=True)["eyeBlinkLeft"]
    assert np.abs(answers["plain"] - answers["placed"]).mean() < 0.08
    assert np.corrcoef(answers["plain"], answers["placed"])[0, 1] > 0.95
    # frames of another shape are at fault, not looked at in another place
    wide = write_take(tmp_path / "wide", {"left_eye": placed[:, :90]})
    words = ("headset-tracking3", *wide, "--placement", out, "--out", tmp_path / "wide.csv")
    _, _, told = run("headset", "predict", *words)
    assert "all of its 40 frames have a picture of another shape" in told


def test_a_sheet_of_another_ending_is_refused_before_anything_is_judged(run, tmp_path: Path):
    out, sheet = tmp_path / "placement.toml", tmp_path / "sheet.txt"
    code, _, told = run(
        "headset", "check", "headset-tracking3", "--mouth", "none", "--out", out, "--sheet", sheet
    )
    assert code == 2
    assert f"--sheet is {sheet}; a sheet ends with .png" in told
    assert not list(tmp_path.iterdir())


def test_what_cannot_be_judged_is_refused(predictor: HeadsetPredictor, take: Take, tmp_path: Path, run):
    with pytest.raises(InputError, match="left_eye has 5 usable frames; at least 20"):
        judge(predictor, {"left_eye": take["left_eye"][:5]})
    with pytest.raises(InputError, match="left_eye has 1 usable frame; at least 20"):
        judge(predictor, {"left_eye": take["left_eye"][:1]})
    older = load_headset_predictor(write_tiny_model(tmp_path / "older"))
    with pytest.raises(InputError, match="does not say how the pictures of left_eye looked in training"):
        judge(older, {"left_eye": take["left_eye"]})
    code, _, said = run("headset", "check", "headset-tracking3")
    assert (code, "give the cameras' paths" in said) == (2, True)
    (tmp_path / "empty").mkdir()
    code, _, said = run("headset", "check", "headset-tracking3", "--left-eye", tmp_path / "empty")
    assert (code, "no picture that can be read" in said) == (2, True)


@pytest.mark.parametrize(
    ("x", "size", "lost"),
    [
        (0.0, 1.4, True),
        (0.5, 2.4, True),
        (0.5, 0.3, True),
        (0.4, 1.4, False),
        (0.1, 1.4, False),  # these two are found where edges fade, further out
        (0.5, 1.7, False),
    ],
)
def test_a_search_that_is_held_at_its_limits_gives_the_whole_picture(
    predictor: HeadsetPredictor,
    take: Take,
    monkeypatch: pytest.MonkeyPatch,
    x: float,
    size: float,
    lost: bool,
):
    def best(self, start: CameraPlacement) -> FoundPlacement:
        unrest = 0.03 if start.mirror and not start.roll_deg else 0.05
        placement = replace(start, x=x, size=size)
        return FoundPlacement(placement=placement, deviation=0.1, unrest=unrest, unsettled=0.1)

    monkeypatch.setattr(Search, "best", best)
    found = find_placement(predictor, "left_eye", take["left_eye"])
    assert found.lost == lost
    assert found.placement == (
        CameraPlacement(mirror=True) if lost else replace(found.placement, x=x, size=size)
    )
    (one,) = judge(predictor, {"left_eye": take["left_eye"]})
    assert (Misfit.LOST in {finding.misfit for finding in one.findings}) == lost
    assert one.placement.mirror


@pytest.mark.parametrize(
    ("model", "plain", "faded", "taken"),
    [
        ("headset-tracking3", (180.0, 0.05), (0.0, 0.06), "faded"),  # cameras are seldom upside down
        ("headset-tracking3", (180.0, 0.05), (180.0, 0.04), "plain"),
        (
            "headset-tracking3",
            (0.0, 0.06),
            (0.0, 0.05),
            "plain",
        ),  # streaks place eyes closer where they do not mislead
        ("headset-tracking3", (0.0, 0.06), (0.0, 0.03), "faded"),
        (
            "headset-tracking3",
            (0.0, 0.03),
            (0.0, 0.01),
            "plain",
        ),  # what is not doubtful is not looked for again
        ("headset-any", (180.0, 0.06), (0.0, 0.03), "plain"),
    ],
)
def test_what_is_doubtful_is_looked_for_again_where_edges_fade(
    take: Take,
    monkeypatch: pytest.MonkeyPatch,
    model: str,
    plain: tuple[float, float],
    faded: tuple[float, float],
    taken: str,
):
    sizes = {False: 1.1, True: 1.2}

    def best(self, start: CameraPlacement) -> FoundPlacement:
        roll_deg, unrest = faded if self.fades else plain
        if start.roll_deg != roll_deg:
            unrest = 0.2
        placement = replace(start, size=sizes[self.fades])
        return FoundPlacement(placement=placement, deviation=0.1, unrest=unrest, unsettled=0.0)

    monkeypatch.setattr(Search, "best", best)
    monkeypatch.setattr(Search, "surely_upright", False)
    found = find_placement(load_headset_predictor(model), "left_eye", take["left_eye"])
    assert found.placement.size == sizes[taken == "faded"]
    assert found.turned == ((faded if taken == "faded" else plain)[0] != 0)


def test_of_two_places_as_good_the_one_that_looks_more_like_training_is_taken(
    predictor: HeadsetPredictor, take: Take
):
    points = EyePoints.of(predictor, "left_eye")
    search = Search(predictor, "left_eye", points, take["left_eye"][:8], fades=False)
    upright, turned = (search.best(CameraPlacement(roll_deg=roll_deg)).likeness for roll_deg in (0.0, 180.0))
    assert upright > turned + 0.2
    found = {"placement": CameraPlacement(), "deviation": 0.1, "unrest": 0.02, "unsettled": 0.0}
    assert FoundPlacement(**found, likeness=upright).score < FoundPlacement(**found, likeness=turned).score


def test_a_step_says_how_far_out_the_eye_lies_whatever_the_limits_are(predictor: HeadsetPredictor):
    points = EyePoints.of(predictor, "left_eye")
    far = points.usual.mean(axis=0) + 3 * (points.usual - points.usual.mean(axis=0)) + [400.0, 0.0]
    view = predictor.sizes["left_eye"]
    wanted = placement_of_points(CameraPlacement(), far[None], points, picture=view, view=view)
    assert wanted.size == pytest.approx(3)
    assert wanted.x > 2


@pytest.mark.parametrize("width", [200, 320])
def test_a_view_is_moved_by_as_much_of_its_width_in_pictures_of_any_shape(width: int):
    """`_MOVES` are of the view; places are shares of the picture's width and height, which differ."""
    placed = CameraPlacement(x=0.4, y=0.6, size=0.8)
    across, down = np.diff([(one.x * width, one.y * 200) for one in _moved(placed, width / 200)][:2], axis=0)[
        0
    ] / (0.8 * width)
    assert (across, down) == pytest.approx((-0.06, 0.03))
    beside, below = replace(placed, x=0.5), replace(placed, y=0.6 + 0.1 * width / 200)
    assert _apart(placed, beside, width / 200) == pytest.approx(_apart(placed, below, width / 200))


def test_a_network_of_drawn_headsets_is_not_led_to_the_usual_eye(predictor: HeadsetPredictor, take: Take):
    """It knows eyes of every size, so the picture as it comes is settled; far out it is led like any network."""
    for model, settled in ((load_headset_predictor("headset-any"), True), (predictor, False)):
        points = EyePoints.of(model, "left_eye")
        search = Search(model, "left_eye", points, take["left_eye"][:8], fades=False)
        found = search.best(CameraPlacement(size=0.85, roll_deg=10.0))
        assert (found.unsettled == 0.0) == settled
    assert not _is_as_drawn(CameraPlacement(), CameraPlacement(size=1.6), 1.0)
    assert not _is_as_drawn(CameraPlacement(), CameraPlacement(x=0.7), 1.0)
    assert not _is_as_drawn(CameraPlacement(roll_deg=170.0), CameraPlacement(roll_deg=-150.0), 1.0)
    assert _is_as_drawn(CameraPlacement(roll_deg=170.0), CameraPlacement(roll_deg=-170.0), 1.0)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda frames: frames[:, :72], "all of each picture, as without it, so predict needs none"),
        (lambda frames: frames[:, 24:64], "then give it to `regress headset predict --placement"),
        (lambda frames: frames[:, ::-1, ::-1], "then give it to `regress headset predict --placement"),
    ],
    ids=["4:3", "a strip", "upside down"],
)
def test_predict_needs_no_placement_only_where_it_takes_the_frames(
    run, tmp_path: Path, change: Callable[[np.ndarray], np.ndarray], said: str
):
    """Pictures of another usual shape are taken as they are, and strips are at fault without a placement."""
    mouth = np.stack(
        [cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in sorted((TAKE / "mouth").glob("*.png"))]
    )
    options = write_take(tmp_path, {"mouth": np.ascontiguousarray(change(mouth))})
    code, out, told = run(
        "headset", "check", "headset-tracking3", *options, "--out", tmp_path / "placement.toml"
    )
    assert code == 0
    assert said in told, out + told


def test_a_dark_picture_is_in_no_lens_circle(predictor: HeadsetPredictor):
    """Its corners are as dark as a rim."""
    mouth = np.stack(
        [cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in sorted((TAKE / "mouth").glob("*.png"))]
    )
    (one,) = judge(predictor, {"mouth": brighter(mouth, 0.35)})
    assert {finding.misfit for finding in one.findings} == {Misfit.DARK}


def test_a_path_that_is_not_there_is_said_to_be_none(run, tmp_path: Path):
    code, _, told = run("headset", "check", "headset-tracking3", "--left-eye", tmp_path / "nope")
    assert (code, "nope does not exist" in told) == (2, True), told


def test_a_minutes_frames_are_looked_at_without_copies_of_them_all():
    take = np.random.default_rng(0).integers(0, 256, (600, 240, 320), dtype=np.uint8)
    tracemalloc.start()
    assert flicker_of(take) < 0.01
    assert _are_the_same(take, take)
    assert not _are_the_same(take, take[::-1])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < take.nbytes
