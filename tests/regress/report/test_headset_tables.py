"""Words of the tables of a headset network's report."""

from regress.learning.headset.comparison import Rivalry
from regress.report.headset_tables import WORDS, conditions_table, rivals_table
from regress.runtime.headset.network.figures import Summary

ROW = Rivalry(rows=4, geometry_mm=1.0, rival_mm=2.0, better=0.5, people=0.5)
FIGURES = Summary(
    rows=4, geometry_mm=1.0, r2=0.5, mae=0.1, rmse=0.2, blink_r2=0.9, gaze_deg=3.0, gaze_open_deg=None
)


def test_faces_at_rest_are_no_floor():
    # "rest" names a component of the expressions as well as the floor that always answers the resting face
    rows = rivals_table({"rest": ROW, "one_sided": ROW}, names=("modular", "holistic")).rows
    assert [row[0].text for row in rows] == ["rest", "one sided"]
    rows = conditions_table({"uncalibrated": FIGURES}, {"rest": FIGURES}).rows
    assert [row[0].text for row in rows] == ["no neutral picture", "floor: always the resting face"]


def test_every_condition_is_called_otherwise():
    assert len(set(WORDS.values())) == len(WORDS)
