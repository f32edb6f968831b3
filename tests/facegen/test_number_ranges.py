"""Ranges of numbers count what nobody could list, and agree with lists where those are short."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.errors import InputError
from facegen.number_ranges import (
    MOST_LISTED,
    format_ranges,
    format_runs,
    listed,
    parse_ranges,
    sample_numbers,
    sample_ranges,
    without,
)

PIECES = st.lists(
    st.tuples(st.integers(0, 60), st.integers(0, 30), st.integers(1, 5)).map(
        lambda piece: f"{piece[0]}-{piece[0] + piece[1]}:{piece[2]}"
    ),
    max_size=4,
)


@given(PIECES)
def test_ranges_are_the_numbers_of_their_pieces(pieces):
    numbers = sorted({number for run in parse_ranges(",".join(pieces), where="here") for number in run})
    assert sample_numbers(",".join(pieces), total=100, where="here") == numbers
    assert sample_numbers(format_ranges(numbers), total=100, where="here") == numbers


@given(st.sets(st.integers(0, 60)), st.sets(st.integers(-5, 70)), st.integers(0, 60), st.integers(0, 60))
def test_what_is_left_is_what_is_not_taken(numbers, taken, first, length):
    for some in (sorted(numbers), range(first, first + length)):
        left = [number for number in some if number not in taken]
        runs = without(some, taken)
        assert [number for run in runs for number in run] == left
        assert format_runs(runs) == format_ranges(left)
        assert format_ranges(some) == format_ranges(list(some))


def test_one_range_counts_what_nobody_could_list():
    numbers = sample_ranges("0-99999999999999999", total=10**18, where="here")
    assert len(numbers) == 10**17
    assert without(numbers, [5])[1] == range(6, 10**17)
    assert format_ranges(numbers) == "0-99999999999999999"
    with pytest.raises(InputError, match="here: these are 100,000,000,000,000,000 samples"):
        listed(numbers, where="here", what="sample")


@pytest.mark.parametrize(
    "text",
    [
        "0-999999999999:2",
        ",".join(f"{number}-{MOST_LISTED}" for number in range(10)),
        "9" * 5000,
        "0-" + "9" * 5000,
        "\u0661-\u0669",
        "0-9:" + "9" * 5000,
        "-" * 50_000,
    ],
    ids=["stepped", "overlapping", "digits", "last", "arabic", "step", "dashes"],
)
def test_what_cannot_be_listed_or_read_is_refused(text):
    with pytest.raises(InputError, match=r"^here: "):
        sample_numbers(text, total=10**15, where="here")
