"""The report's figures: well-formed, inside their frames, and where the numbers say."""

import re
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from regress.report.axes import Scale, figure, label
from regress.report.bars import score_bars
from regress.report.charts import learning_curves, regression_panel, small_curves
from regress.report.content import Figures, LearningCurve, RegressionPlot, ShapeScores, mean_curve
from regress.report.histogram import histogram


def scores(*r2: float) -> list[ShapeScores]:
    def figures(value):
        return Figures(r2=value, mae=0.1, pearson=0.9)

    return [
        ShapeScores(
            name=f"shape{index}",
            region="jaw",
            network=figures(value),
            ridge=figures(value / 2),
            mean=figures(0),
        )
        for index, value in enumerate(r2)
    ]


def curve(train, validation, test=(), best_step=1) -> LearningCurve:
    return LearningCurve(
        name="jaw.open",
        train=np.array(train, dtype=float),
        validation=np.array(validation, dtype=float),
        test=np.array(test, dtype=float),
        best_step=best_step,
    )


def panel(counts, slope=0.8) -> str:
    return regression_panel(
        RegressionPlot(split="test", counts=np.array(counts), slope=slope, intercept=0.1, pearson=0.9)
    )


def numbers_in_frame(svg: str) -> bool:
    """All coordinates of lines, rectangles and texts lie in the view box."""
    root = ElementTree.fromstring(svg)
    _, _, width, height = map(float, root.attrib["viewBox"].split())
    for element in root.iter():
        for keys, limit in ((("x", "x1", "x2"), width), (("y", "y1", "y2"), height)):
            for key in keys:
                if not 0 <= float(element.attrib.get(key, 0)) <= limit:
                    return False
    return True


@pytest.mark.parametrize(
    "svg",
    [
        learning_curves(curve([1, 0.5, 0.2], [1, 0.6, 0.7], [1, 0.7, 0.75])),
        learning_curves(curve([1.0], [1.0])),
        learning_curves(curve([0.0, 0.0], [0.0, 0.0])),
        small_curves(curve([1, 0.5], [1, 0.6]), low=0.1, high=2),
        panel(np.eye(51, dtype=int) * 7),
        panel(np.zeros((51, 51), dtype=int), slope=np.nan),
    ],
)
def test_figures_are_well_formed_and_stay_in_their_frames(svg):
    assert numbers_in_frame(svg)


@pytest.mark.parametrize("r2", [(0.9, 0.5, 0.05, -3.0, 1.0), (0.9, np.nan), (-0.1,)])
def test_bars_stay_in_their_tracks(r2):
    root = ElementTree.fromstring(score_bars(scores(*r2)))
    places = [dict(part.split(":") for part in one.attrib["style"].split(";")) for one in root.iter("b")]
    assert len(places) == np.isfinite(r2).sum()
    for place in places:
        left, width = (float(place[key].removesuffix("%")) for key in ("left", "width"))
        assert left >= 0
        assert left + width <= 100.3  # the thinnest bar is wider than nothing
    assert "".join(root.itertext()).count("never moves") == np.isnan(r2).sum()


def test_bars_are_as_long_as_the_score():
    bars = list(ElementTree.fromstring(score_bars(scores(0.8, 0.4))).iter("b"))
    long, short = (float(re.search(r"width:([\d.]+)%", bar.attrib["style"])[1]) for bar in bars)
    assert long == pytest.approx(2 * short, rel=0.01)
    assert [bar.attrib["class"] for bar in bars] == ["seen", "partly"]


def test_density_puts_the_truth_across_and_the_prediction_up():
    counts = np.zeros((51, 51), dtype=int)
    counts[0, 0], counts[50, 25], counts[50, 50] = 100, 10, 1
    cells = re.findall(r'class="cell" fill-opacity="([\d.]+)" d="M([\d.]+) ([\d.]+)h', panel(counts))
    (faint, *_), (middle, *_), (full, *_) = cells
    (top_x, top_y), (middle_x, middle_y), (corner_x, corner_y) = ((float(x), float(y)) for _, x, y in cells)
    assert float(faint) < float(middle) < float(full) == 1
    assert corner_x < middle_x == top_x
    assert top_y < middle_y < corner_y


def test_names_of_curves_that_end_together_stay_apart():
    svg = learning_curves(curve([1, 0.5], [1, 0.5], [1, 0.5]))
    places = sorted(float(y) for y in re.findall(r'class="label \w+" x="[\d.]+" y="([\d.]+)"', svg))
    assert np.diff(places).min() >= 14


def test_mean_curve_holds_a_stopped_network_at_its_last_error():
    mean = mean_curve((curve([1, 0.5], [1, 0.6]), curve([1, 0.4, 0.2, 0.1], [1, 0.5, 0.3, 0.2])))
    np.testing.assert_allclose(mean.train, [1, 0.45, 0.35, 0.3])
    np.testing.assert_allclose(mean.validation, [1, 0.55, 0.45, 0.4])
    assert len(mean.test) == 0


@pytest.mark.parametrize("decades", [(0.15, 0.31), (0.5, 0.9), (0.02, 1.2), (1e-5, 3)])
def test_logarithmic_ticks_lie_inside_and_are_neither_few_nor_crowded(decades):
    low, high = decades
    ticks = Scale(low=low, high=high, start=0, stop=1, logarithmic=True).ticks()
    assert 3 <= len(ticks) <= 9
    assert low <= ticks[0]
    assert ticks[-1] <= high


def test_ticks_are_round_numbers_with_a_true_minus_sign():
    ticks = Scale(low=-0.2, high=1, start=0, stop=1).ticks()
    assert [label(tick) for tick in ticks] == ["0", "0.25", "0.5", "0.75", "1"]
    assert label(-0.25) == "\N{MINUS SIGN}0.25"


def test_figures_have_three_decimals_and_no_negative_zero():
    texts = [figure(value) for value in (0.12345, -0.5, -0.0001, float("nan"))]
    assert texts == ["0.123", "\N{MINUS SIGN}0.500", "0.000", "\N{EN DASH}"]


@pytest.mark.parametrize("values", [[0.5, 0.62, 0.7], [0.01, 0.01, 0.9], [0.9, 0.9, 0.1], [3.0]])
def test_a_histogram_says_what_its_axes_are_and_where_the_median_is(values):
    """All of its words stay inside of the picture."""
    drawn = histogram(np.array(values), "error in mm")
    assert f">median {np.median(values):.3g}<" in drawn
    assert ">error in mm<" in drawn
    assert ">people<" in drawn
    width, height = (float(side) for side in re.search(r'viewBox="0 0 (\d+) (\d+)"', drawn).groups())
    for x, y, words in re.findall(r'<text class="tick middle" x="([\d.]+)" y="([\d.]+)">([^<]+)<', drawn):
        half = 3.2 * len(words)
        assert half < float(x) + 1
        assert float(x) + half < width + 6
        assert 8 < float(y) < height
