"""Labels of one label version stay what they are: a few rows and figures of all, as they were when they were read over.

Equal specs give equal labels as long as `LABEL_VERSION` stays. No other test holds one commit to another.
"""

import json
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from facegen.formats import live_link_csv
from facegen.rigs import Rig
from facegen.spec import LABEL_VERSION, parse_spec
from facegen.store import resolve
from facegen.store.blocks import draw_block, label_block
from facegen.store.keypoint_table import column_array
from facegen.store.record import sample_record
from facegen.work.worker import label_sample

GOLDEN = Path(__file__).with_name("golden_labels.json")

DECIMALS = {
    **{"points_2d": 2, "detected_2d": 2, "intrinsics": 2, "points_3d": 5},
    **{"weights": 4, "gaze": 4, "camera_from_head": 5},
}
"""Columns that stand there by the row, and their decimals: hundredths of a pixel, and of a millimetre."""

EVERY = 8
"""Landmarks of a row that stand there: 9 of 68 are enough, where all of them are in the means."""

DIGITS = 6
"""Of means and spreads. Other processors differ in the last of float32's seven."""

ELSEWHERE = ("weights", "keypoints", "identity")
"""Keys of a picture's record that the table has as well."""

KINDS: dict[str, dict[str, Any]] = {
    "still": {"kind": "still", "people": 3, "still": {"neutral": 1, "faces": 6}},
    "still, with all that is late": {
        **{"kind": "still", "people": 4, "still": {"neutral": 1, "faces": 6, "sessions": 2}},
        "landmarks": {"sliding_contour": True, "dropped": 0.2, "bias": 1.0, "noise_face_widths": 0.002},
        "looks": {"beard": 0.5, "glasses": 0.5, "make_up": 0.5},
        "sensor": {"slip": 2.0},
        "gaze": {"wide": 0.3},
        "expression": {"blinks": 0.3, "mixture": {"speech": 1, "upper_face": 1, "talk": 1, "tongue": 1}},
        "head": {"yaw_deg": {"uniform": [-40, 40]}},
    },
    "sequence": {
        **{"kind": "sequence", "people": 2},
        "sequence": {
            **{name: {"count": 1, "seconds": 2.0} for name in ("neutral", "sentence")},
            "peak": {"count": 2, "seconds": 2.0},
        },
    },
    "playback": {"kind": "playback", "people": 2, "playback": {"recording": "take.csv", "fps": 30}},
}
"""Specs whose first block is made."""


def labels(table: dict[str, Any], folder: Path) -> dict[str, Any]:
    """What the golden file has of a spec: rows of its first block, figures of the block and of a picture's labels."""
    if "playback" in table:
        taken = np.random.default_rng(3).random((12, len(BLENDSHAPES)))
        (folder / "take.csv").write_text(live_link_csv(taken, np.arange(12) / 30))
        table = table | {"playback": table["playback"] | {"recording": str(folder / "take.csv")}}
    spec = parse_spec(table | {"version": 1, "seed": 11, "render": {"headset": "tracking3"}}, where="test")
    dataset = resolve(spec, folder / "out")
    drawn = draw_block(dataset, 0)
    block = label_block(dataset, 0, drawn)
    columns = {name: column_array(block, name) for name in block.column_names}
    number = len(block) // 2
    return {
        "rows": {str(row): _row(columns, row) for row in (0, number)},
        "block": {name: _summary(values) for name, values in columns.items() if values.dtype.kind in "fiub"},
        "picture": _picture(
            sample_record(label_sample(dataset, number, drawn["anny"]), dataset_hash="", rig="anny")
        ),
    }


def _row(columns: dict[str, np.ndarray], row: int) -> dict[str, list[float | None]]:
    few = {name: columns[name][row] for name in DECIMALS}
    few |= {name: values[::EVERY] for name, values in few.items() if name.startswith(("points", "detected"))}
    return {name: [_number(each, DECIMALS[name]) for each in values.ravel()] for name, values in few.items()}


def _number(value: float, decimals: int) -> float | None:
    return None if np.isnan(value) else round(float(value), decimals) + 0.0


def _summary(values: np.ndarray) -> list[float]:
    """How many numbers are NaN; of the others the spread, and a mean by place, which sees their order."""
    flat = values.astype(float).ravel()
    found = ~np.isnan(flat)
    if not found.any():
        return [len(flat)]
    placed = flat * np.linspace(0.5, 1.5, len(flat))
    figures = (flat[found].std(), placed[found].mean())
    return [int((~found).sum()), *(float(f"{figure:.{DIGITS}g}") for figure in figures)]


def _picture(record: dict[str, Any]) -> dict[str, list[float]]:
    """Figures of a picture's record by its outer keys: two of them, and three of a camera's labels."""
    parts: defaultdict[str, list[float | None]] = defaultdict(list)
    for keys, number in _numbers({key: value for key, value in record.items() if key not in ELSEWHERE}):
        parts[".".join(keys[: 3 if keys[0] == "views" else 2])].append(number)
    return {name: _summary(np.array(values, float)) for name, values in sorted(parts.items())}


def _numbers(record: Any, keys: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], float | None]]:
    """Numbers of a record, each by the keys that lead to it."""
    if isinstance(record, dict):
        for key, value in record.items():
            yield from _numbers(value, (*keys, key))
    elif isinstance(record, list | tuple):
        for value in record:
            yield from _numbers(value, keys)
    elif record is None or isinstance(record, int | float):
        yield keys, record


def differing(one: Any, other: Any, name: str = "") -> Iterator[str]:
    """Paths at which two golden files differ by more than their rounding."""
    if isinstance(one, dict) and isinstance(other, dict):
        for key in sorted({*one, *other}):
            yield from differing(one.get(key), other.get(key), f"{name} / {key}")
    elif one is None or other is None or len(one) != len(other):
        yield name
    elif not _alike(one, other, DECIMALS.get(name.rsplit(" / ")[-1]) if " / rows / " in name else None):
        yield name


def _alike(one: list, other: list, decimals: int | None) -> bool:
    kept, made = np.array(one, float), np.array(other, float)
    if decimals is not None:
        return np.allclose(kept, made, rtol=0, atol=1.5 * 10.0**-decimals, equal_nan=True)
    return np.allclose(kept, made, rtol=3 * 10.0 ** (1 - DIGITS), atol=1e-6, equal_nan=True)


@pytest.fixture(scope="module")
def made(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    return {kind: labels(table, tmp_path_factory.mktemp("golden")) for kind, table in KINDS.items()}


def test_labels_are_those_of_their_version(made: dict[str, Any], request: pytest.FixtureRequest) -> None:
    kept = json.loads(GOLDEN.read_text()) if GOLDEN.is_file() else {"label_version": None, "kinds": {}}
    changed = [where for kind, old in kept["kinds"].items() for where in differing(old, made.get(kind), kind)]
    same_version = kept["label_version"] == LABEL_VERSION
    # a version that stays promises labels that stay: no option writes others under it
    assert not (changed and same_version), f"raise LABEL_VERSION, or mend what changed: {changed[:20]}"
    if request.config.getoption("--update-golden") and not (
        same_version and kept["kinds"].keys() == made.keys()
    ):
        GOLDEN.write_text(_text({"label_version": LABEL_VERSION, "kinds": made}))
        return
    assert same_version, (
        f"{GOLDEN.name} is of another LABEL_VERSION; read its changes over with --update-golden"
    )
    assert kept["kinds"].keys() == made.keys(), "write the new kinds with --update-golden"


def _text(content: dict[str, Any]) -> str:
    """JSON with a line for each list, so that a change can be read over."""
    text = json.dumps(content, indent=0, separators=(",", ":"))
    return text.replace(",\n", ",").replace("[\n", "[").replace("\n]", "]").replace('],"', '],\n"') + "\n"


@pytest.mark.parametrize("column", ["weights", "gaze", "points_2d", "camera_from_head"])
def test_a_change_of_one_number_is_seen(made: dict[str, Any], column: str) -> None:
    """The comparison itself is held: the least step above the rounding is told, with its place."""
    other = json.loads(json.dumps(made))
    row = next(iter(other["still"]["rows"]))
    other["still"]["rows"][row][column][0] += 3 * 10.0 ** -DECIMALS[column]
    assert list(differing(made, other)) == [f" / still / rows / {row} / {column}"]
    assert list(differing(made, made)) == []
