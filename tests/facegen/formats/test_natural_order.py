"""Names sort as people number things."""

from hypothesis import given
from hypothesis import strategies as st

from facegen.formats.natural_order import natural_order


@given(st.lists(st.integers(0, 10**6), unique=True))
def test_numbers_sort_as_numbers(numbers: list[int]):
    names = [f"frame_{number}.png" for number in numbers]
    assert sorted(names, key=natural_order) == [f"frame_{number}.png" for number in sorted(numbers)]


@given(st.text(), st.text())
def test_any_two_names_have_an_order_and_different_ones_never_the_same_place(one: str, other: str):
    assert (natural_order(one) < natural_order(other)) == (natural_order(other) > natural_order(one))
    assert (natural_order(one) == natural_order(other)) == (one == other)


@given(st.lists(st.integers(0, 10**7), unique=True, min_size=1))
def test_times_of_a_clock_are_sorted_as_times(ticks: list[int]):
    names = [f"left_{1_700_000_000 + tick / 1000}.png" for tick in sorted(ticks)]
    assert sorted(reversed(names), key=natural_order) == names
