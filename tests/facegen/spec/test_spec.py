"""Specs: what is accepted, what is refused and how, and what the hash depends on."""

import hashlib
import json
import tomllib
from dataclasses import replace
from functools import reduce
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator
from pydantic_core import PydanticCustomError

from facegen.errors import InputError
from facegen.spec import (
    LABEL_VERSION,
    draw,
    load_spec,
    loading,
    parse_spec,
    sample_numbers,
    spec_hash,
    spec_reference,
    spec_schema,
    spec_table,
)
from facegen.spec.distribution import as_data, parse

ROOT = Path(__file__).resolve().parents[3]
SMALL = {"version": 1, "kind": "still", "seed": 1, "people": 3}
YOUNG = {
    "still.sessions": 2,
    "landmarks.sliding_contour": True,
    "sensor.slip": 2.0,
    "render.subsurface": False,
    "render.truth": False,
    "expression.mixture.upper_face": 1.0,
    "expression.mixture.lower_face": 1.0,
    "expression.mixture.combined": 1.0,
    "expression.mixture.talk": 1.0,
    "expression.mixture.wink": 1.0,
    "expression.mixture.tongue": 1.0,
    "gaze.wide": 0.5,
    "expression.blinks": 0.5,
    "layout": {"count": 3},
}
"""Keys that came after the first datasets, and values other than their defaults."""
LITERAL = {
    "still": ({}, "0ff58934e38a4aa78f46689aed413e3ad231966d66ade17eeaeb57c2ba2161b3"),
    "sequence": (
        {"kind": "sequence"},
        "efd719f1d3ab2d596f2d2f3e0aa4e29f9835ba4b83f40cfcb3b608f202e65a72",
    ),
    "playback": (
        {"kind": "playback", "playback": {"recording": "take.csv", "fps": 30}},
        "ac040819fb0725d9a102930ce89ac317a7bafab6bdaf25e7aaea4f9424195bc4",
    ),
}
"""Specs, and their hashes of label version 7 as they were written with the first datasets of that version."""


@pytest.mark.parametrize("path", sorted((ROOT / "datasets").glob("*.toml")), ids=lambda p: p.stem)
def test_shipped_specs_load_and_survive_a_round_trip(path):
    spec = load_spec(path)
    assert parse_spec(spec_table(spec), where="again") == spec


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"peple": 3}, ["unknown key 'peple'", "did you mean 'people'"]),
        ({"head": {"yaw_rad": 0.3}}, ["unknown key 'head.yaw_rad'", "'yaw_deg'", "pitch_deg"]),
        ({"camera": {"distance_m": 600}}, ["camera.distance_m", "600", "between 0.2 and 10 metres"]),
        ({"head": {"yaw_deg": "20deg"}}, ["head.yaw_deg", "20deg", "must be a number"]),
        ({"head": {"yaw_deg": {"uniform": [5, 1]}}}, ["head.yaw_deg", "lower bound must be below"]),
        ({"head": {"yaw_deg": {"normal": [0, 0]}}}, ["head.yaw_deg", "above 0"]),
        ({"head": {"yaw_deg": {"normal": [0, 100]}}}, ["head.yaw_deg", "between -60 and 60 degrees"]),
        (
            {
                "kind": "sequence",
                "sequence": {k: {"count": 0, "seconds": 2.0} for k in ("neutral", "sentence")},
            },
            ["sequence has no clips", "count above 0"],
        ),
        ({"sequence": {"peak": {"count": 73}}}, ["sequence.peak.seconds", "missing"]),
        ({"sequence": {"fps": 50}}, ["sequence.fps", "50", "30 or 60"]),
        ({"kind": "stil"}, ["kind", "stil", "'still', 'sequence' or 'playback'"]),
        ({"people": 0}, ["people = 0", "greater than or equal to 1"]),
        ({"people": 2.5}, ["people = 2.5", "whole number"]),
        ({"people": True}, ["people = true"]),
        ({"still": 3}, ["still = 3", "table"]),
        ({"still": {"neutral": 0, "faces": 0}}, ["still.neutral", "at least one"]),
        ({"still": {"faces": 10**30}}, ["still.faces = 1000", "less than or equal to 10000000"]),
        ({"still": {"neutral": 10**30}}, ["still.neutral = 1000", "less than or equal to 10000000"]),
        (
            {"people": 10**8, "split": "session", "still": {"sessions": 1000}},
            ["people = 100000000 with still.sessions = 1000", "up to 100000000", 'split = "person"'],
        ),
        (
            {"kind": "sequence", "people": 10**8, "split": "session", "sequence": {"sessions": 2}},
            ["people = 100000000 with sequence.sessions = 2", "up to 100000000"],
        ),
        ({"split_shares": [0.5, 0.5, 0.5]}, ["split_shares", "add up to 1"]),
        ({"render": {"samples": "0-x"}}, ["render.samples", "'0-x'"]),
        ({"kind": "playback"}, ["[playback]", "recording"]),
        ({"seed": -1}, ["seed = -1"]),
        (
            {"expression": {"symmetric": 0.5}},
            ["unknown key 'expression.symmetric'", "left_right_correlation"],
        ),
        (
            {"expression": {"mixture": {"speach": 1}}},
            ["'expression.mixture.speach'", "did you mean 'speech'", "one_sided"],
        ),
        (
            {"expression": {"mixture": {"speech": -1}}},
            ["expression.mixture.speech = -1", "greater than or equal to 0"],
        ),
        ({"expression": {"mixture": {}}}, ["expression.mixture", "above 0", "speech"]),
        (
            {"expression": {"left_right_correlation": 2}},
            ["expression.left_right_correlation = 2", "less than or equal to 1"],
        ),
        ({"expression": {"model": 2}}, ["expression.model = 2", "1"]),
    ],
)
def test_refusals_say_what_where_and_what_is_allowed(change, words):
    with pytest.raises(InputError) as error:
        parse_spec(SMALL | change, where="x.toml")
    message = str(error.value)
    assert message.startswith("x.toml: ")
    assert "\n" not in message
    for word in words:
        assert word in message


def test_a_missing_key_and_a_missing_file_are_named(tmp_path):
    with pytest.raises(InputError, match="key 'seed' is missing"):
        parse_spec({"version": 1, "kind": "still", "people": 3}, where="x.toml")
    with pytest.raises(InputError, match="there is no such spec"):
        load_spec(tmp_path / "none.toml")
    (tmp_path / "broken.toml").write_text("people = = 3")
    with pytest.raises(InputError, match="not valid TOML"):
        load_spec(tmp_path / "broken.toml")


def test_young_keys_stay_out_of_the_hash_of_specs_that_do_not_use_them():
    spec, assets = parse_spec(SMALL, where=""), {"rig": "a"}
    # what the hash was before these keys: that of a table without them
    old = spec_table(spec)
    for path in YOUNG:
        *outer, key = path.split(".")
        del reduce(dict.__getitem__, outer, old)[key]
    del old["render"]["samples"], old["render"]["headset"]
    content = {"spec": old, "assets": assets, "label_version": LABEL_VERSION}
    base = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
    assert spec_hash(spec, asset_sha256=assets) == base
    for path, value in YOUNG.items():
        used = spec_table(spec)
        *outer, key = path.split(".")
        reduce(dict.__getitem__, outer, used)[key] = value
        assert spec_hash(parse_spec(used, where=""), asset_sha256=assets) != base, path


@pytest.mark.parametrize(("change", "sha256"), LITERAL.values(), ids=LITERAL)
def test_hashes_are_those_of_datasets_that_exist(change, sha256, monkeypatch):
    """A key that is new and not late would give every dataset another hash, and all that is made would be refused."""
    monkeypatch.setattr(loading, "LABEL_VERSION", 7)
    assert spec_hash(parse_spec(SMALL | change, where=""), asset_sha256={"rig": "a"}) == sha256


def test_hash_depends_on_what_decides_samples_and_on_nothing_else():
    spec = parse_spec(SMALL, where="")
    assets = {"rig": "a"}
    base = spec_hash(spec, asset_sha256=assets)
    assert base == spec_hash(parse_spec(spec_table(spec), where=""), asset_sha256=assets)
    assert base == spec_hash(replace(spec, render=replace(spec.render, samples="0-1")), asset_sha256=assets)
    assert base != spec_hash(replace(spec, seed=2), asset_sha256=assets)
    assert base != spec_hash(replace(spec, render=replace(spec.render, size_px=64)), asset_sha256=assets)
    assert base != spec_hash(spec, asset_sha256={"rig": "b"})


def test_schema_lists_every_key():
    properties = spec_schema()["properties"]
    assert set(properties) == set(spec_table(parse_spec(SMALL, where="")))


SCHEMA = Draft202012Validator(spec_schema())


def test_schema_is_one_and_takes_the_shipped_specs():
    Draft202012Validator.check_schema(SCHEMA.schema)
    for path in (ROOT / "datasets").glob("*.toml"):
        SCHEMA.validate(tomllib.loads(path.read_text()))


@pytest.mark.parametrize(
    "change",
    [
        {"peple": 3},
        {"head": {"yaw_deg": {"uniform": [5, 100]}}},
        {"head": {"yaw_deg": {"uniform": [5]}}},
        {"head": {"yaw_deg": {"normal": [0, 0]}}},
        {"head": {"yaw_deg": {"normal": [0, 5], "between": [-5, 5]}}},
        {"camera": {"distance_m": 600}},
        {"expression": {"mixture": {"speech": -1}}},
        {"expression": {"left_right_correlation": 1.5}},
    ],
)
def test_schema_refuses_what_loading_refuses(change):
    SCHEMA.validate(SMALL | {"head": {"yaw_deg": {"normal": [0, 5], "within": [-5, 5]}}})
    assert not SCHEMA.is_valid(SMALL | change)
    with pytest.raises(InputError):
        parse_spec(SMALL | change, where="")


def test_the_page_of_keys_is_what_the_command_prints():
    """Write it anew with ``facegen spec reference > docs/spec.md``."""
    page = spec_reference()
    assert (ROOT / "docs" / "spec.md").read_text(encoding="utf-8") == page
    rows = [line.split(" | ") for line in page.splitlines() if line.startswith("| `")]
    assert len(rows) > 40
    assert all(row[-1].removesuffix(" |").strip() for row in rows), "a key lacks its docstring"


_numbers = st.floats(-50, 50, allow_nan=False).map(lambda x: round(x, 3))
_distributions = st.one_of(
    _numbers,
    st.tuples(_numbers, _numbers).filter(lambda p: p[0] < p[1]).map(lambda p: {"uniform": list(p)}),
    st.tuples(_numbers, st.floats(0.01, 20)).map(lambda p: {"normal": list(p)}),
)


@given(_distributions, st.integers(0, 2**32))
def test_draws_stay_within_their_bounds_and_data_survives(data, seed):
    distribution = parse(data)
    assert parse(as_data(distribution)) == distribution
    values = draw(distribution, np.random.default_rng(seed), 50)
    assert values.shape == (50,)
    assert (values >= distribution.low).all()
    assert (values <= distribution.high).all()


@pytest.mark.parametrize(
    ("value", "says"),
    [
        ({"normal": [0, float("nan")], "within": [-1, 1]}, "two finite numbers"),
        ({"normal": [0, float("inf")], "within": [-1, 1]}, "two finite numbers"),
        ({"uniform": [float("nan"), 1]}, "two finite numbers"),
        ({"normal": [0, 1], "within": [9, 10]}, "within lies more than 6 standard deviations from the mean"),
        (
            {"normal": [20, 1], "within": [-10, -5]},
            "within lies more than 6 standard deviations from the mean",
        ),
    ],
)
def test_distributions_that_draw_nothing_sensible_are_refused(value, says):
    with pytest.raises(PydanticCustomError, match=says):
        parse(value)


def test_truncated_normal_has_the_moments_of_its_formula():
    values = draw(parse({"normal": [2.0, 3.0], "within": [-1.0, 5.0]}), np.random.default_rng(0), 200_000)
    # cut at one standard deviation on both sides: variance is (1 - 2 phi(1) / (2 Phi(1) - 1)) sd^2 = 0.2911 sd^2
    assert values.mean() == pytest.approx(2.0, abs=0.02)
    assert values.var() == pytest.approx(0.2911 * 9.0, rel=0.01)


@pytest.mark.parametrize(
    ("text", "numbers"),
    [("", []), ("3", [3]), ("0-3", [0, 1, 2, 3]), ("0-9:4, 1", [0, 1, 4, 8]), ("2,2,1-2", [1, 2])],
)
def test_sample_numbers(text, numbers):
    assert sample_numbers(text, total=10, where="here") == numbers


@pytest.mark.parametrize("text", ["-1", "3-1", "1:2", "a", "1-2-3", "10"])
def test_sample_numbers_refuses(text):
    with pytest.raises(InputError, match=r"^here: "):
        sample_numbers(text, total=10, where="here")


def test_a_mistyped_key_is_named_first_whatever_else_is_wrong():
    table = {"version": 2, "kind": "stil", "seed": -1, "rig": 5, "peple": 6}
    with pytest.raises(InputError, match=r"^here: unknown key 'peple'; did you mean 'people'\?"):
        parse_spec(table, where="here")


@pytest.mark.parametrize(
    "text",
    [
        "[head]\nyaw_deg = {}\n",
        "[head]\nyaw_deg = {{uniform = [-20, {}]}}\n",
        "rig = {{anny = {}, ict = 1}}\n",
        "[sensor]\nnoise = {}\n",
    ],
)
def test_a_whole_number_beyond_all_floats_is_refused(tmp_path: Path, text: str):
    spec = tmp_path / "spec.toml"
    spec.write_text('version = 1\nkind = "still"\nseed = 1\npeople = 3\n' + text.format("1" + 400 * "0"))
    with pytest.raises(InputError):
        load_spec(spec)
