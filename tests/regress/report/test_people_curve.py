"""The learning curve over people: well-formed, and errors where the numbers say."""

import re
import xml.etree.ElementTree as ElementTree
from types import SimpleNamespace

import pytest

from regress.report.people_curve import CurvePoint, people_curve


def point(people: int, alone: float, calibrated: float | None = None) -> CurvePoint:
    conditions = {"uncalibrated": SimpleNamespace(geometry_mm=alone)}
    if calibrated is not None:
        conditions["same_seat"] = SimpleNamespace(geometry_mm=calibrated)
    figures = SimpleNamespace(conditions=conditions)
    return CurvePoint(title=f"m{people}", people=people, rows=10 * people, figures=figures)


def paths(drawing: str) -> dict[str, list[tuple[float, float]]]:
    ElementTree.fromstring(drawing)
    found = re.findall(r'class="curve (\w+)" d="M([^"]+)"', drawing)
    return {kind: [tuple(map(float, place.split())) for place in d.split("L")] for kind, d in found}


def test_errors_fall_down_the_page_and_people_rise_across():
    drawing = people_curve([point(400, 0.8, 0.6), point(100, 1.2, 1.0), point(200, 1.0, 0.8)])
    found = paths(drawing)
    assert set(found) == {"test", "train"}
    for places in found.values():
        across, down = zip(*places, strict=True)
        assert across[1] - across[0] == pytest.approx(across[2] - across[1], abs=0.2)  # doubled twice
        assert down[0] < down[1] < down[2]
    assert all(f">{people}<" in drawing for people in (100, 200, 400))


def test_networks_without_calibration_have_one_curve():
    assert set(paths(people_curve([point(50, 1.0), point(90, 0.9)]))) == {"test"}
    assert len(paths(people_curve([point(50, 1.0)]))["test"]) == 1
