"""Pictures in line: a pause of the machine loses none, a slow reader sees the newest alone, cameras stay matched.

Time is simulated: a camera's picture comes when the test says so, and a reader takes as long as the test says.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from track.sources import Capture, Picture, Source
from track.sources.backlog import LONGEST_S, Backlog
from track.sources.camera import Camera

PICTURES = 60
NAMES = ("left", "right", "mouth")


@dataclass(frozen=True)
class Coming:
    """A camera's picture, in the order in which pictures come."""

    came_s: float
    name: str
    number: int
    time_s: float


@dataclass
class Taken:
    """A sample: when it was read, and the numbers of the pictures that are new in it."""

    at_s: float
    numbers: dict[str, int]
    newest: dict[str, Coming]
    """What each camera gave last, at that time."""
    faults: dict[str, object] = field(default_factory=dict)


class _Cable(Source):
    title, endless = "camera", False

    def close(self) -> None:
        """Nothing is held."""


@dataclass
class Simulation:
    """A capture without threads, which stands in for the condition by which the reader waits for pictures."""

    coming: list[Coming]
    now_s: float = 0.0
    came: dict[int, Coming] = field(default_factory=dict)
    newest: dict[str, Coming] = field(default_factory=dict)

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, *_: object) -> None:
        """Nobody else is there."""

    def notify_all(self) -> None:
        """Nobody else is there."""

    def wait(self, timeout: float) -> None:
        """Let time pass until the next picture comes, or so long."""
        until_s = self.now_s + timeout
        if self.coming and self.coming[0].came_s <= until_s:
            self.deliver()
        else:
            self.now_s = until_s

    def deliver(self) -> None:
        one = self.coming.pop(0)
        self.now_s = max(self.now_s, one.came_s)
        picture = Picture(time_s=one.time_s, pixels=np.full((8, 8), 100, np.uint8))
        self.came[id(picture.pixels)] = one
        self.kept.append(picture)
        self.newest[one.name] = one
        self.capture._cameras[one.name]._keep(picture)

    def work(self, seconds: float) -> None:
        """Let the reader be busy; pictures come meanwhile."""
        until_s = self.now_s + seconds
        while self.coming and self.coming[0].came_s <= until_s:
            self.deliver()
        self.now_s = until_s

    def run(self, works_s: Sequence[float]) -> list[Taken]:
        """Read all pictures; the reader is busy for each of these times in turn, again and again."""
        time = SimpleNamespace(perf_counter=lambda: self.now_s)
        threads = SimpleNamespace(Condition=lambda: self)
        self.kept: list[Picture] = []
        names = sorted({each.name for each in self.coming})
        with (
            patch("track.sources.capture.time", time),
            patch("track.sources.camera.time", time),
            patch("track.sources.capture.threading", threads),
            patch.object(Camera, "start", lambda self: None),
            Capture(dict.fromkeys(names, _Cable)) as self.capture,
        ):
            taken, last = [], dict.fromkeys(names, -1)
            while self.coming or any(camera.waiting for camera in self.capture._cameras.values()):
                sample = self.capture.read()
                found = {name: self.came[id(pixels)].number for name, pixels in sample.pictures.items()}
                new = {name: number for name, number in found.items() if number != last[name]}
                last |= new
                if new:
                    taken.append(Taken(self.now_s, new, dict(self.newest), dict(sample.faults)))
                self.work(works_s[len(taken) % len(works_s)])
            return taken


def pictures(
    step_s: float, phases: Sequence[float], jitter: Sequence[float], lost: Sequence[tuple[str, int]] = ()
) -> list[Coming]:
    """What cameras give; phases and jitter are parts of a step."""
    coming = []
    for place, phase in enumerate(phases):
        for number in range(PICTURES):
            time_s = (1 + number + phase) * step_s
            late_s = step_s * jitter[(number * len(phases) + place) % len(jitter)]
            if (NAMES[place], number) not in lost:
                coming.append(Coming(time_s + late_s, NAMES[place], number, time_s))
    return sorted(coming, key=lambda each: each.came_s)


def numbers_of(taken: Sequence[Taken], name: str) -> list[int]:
    return [each.numbers[name] for each in taken if name in each.numbers]


steps = st.floats(0.008, 0.04)
near = st.lists(st.floats(0.0, 0.2), min_size=1, max_size=3)
little = st.lists(st.floats(0.0, 0.05), min_size=1, max_size=7)


@settings(deadline=None)
@given(steps, near, little, st.floats(0.02, 0.45), st.floats(0.0, 0.025), st.integers(5, 40))
def test_a_pause_loses_no_picture_and_is_caught_up(step_s, phases, jitter, share, pause_s, at):
    works_s = [share * step_s] * 1000
    works_s[at] += pause_s
    taken = Simulation(pictures(step_s, phases, jitter)).run(works_s)
    for name in NAMES[: len(phases)]:
        assert numbers_of(taken, name) == list(range(PICTURES))
    assert all(len(set(each.numbers.values())) == 1 for each in taken), "pictures of one time go together"
    spread_s = (max(phases) + max(jitter)) * step_s
    for each in taken[-10:]:
        age_s = each.at_s - (1 + each.numbers[NAMES[0]] + phases[0]) * step_s
        assert age_s <= spread_s + 1e-9, "long after the pause nothing waits in line"


@settings(deadline=None)
@given(steps, near, little, st.floats(1.1, 6.0))
def test_a_reader_slower_than_the_camera_sees_the_newest_pictures_alone(step_s, phases, jitter, share):
    work_s = share * step_s
    taken = Simulation(pictures(step_s, phases, jitter)).run([work_s])
    begun_s, over_s = 2 * step_s + LONGEST_S + work_s, PICTURES * step_s
    settled = [each for each in taken if begun_s < each.at_s < over_s]
    for each in settled:
        assert each.numbers == {name: coming.number for name, coming in each.newest.items()}


@settings(deadline=None)
@given(
    st.lists(st.floats(0.0, 0.08), min_size=1, max_size=20),
    st.lists(st.floats(0.0, 0.2), min_size=1, max_size=20),
)
def test_at_no_pace_is_a_picture_older_than_the_line_or_given_twice(gaps_s, works_s):
    times_s = np.cumsum([0.001 + gaps_s[number % len(gaps_s)] for number in range(PICTURES)])
    coming = [Coming(float(time_s), "left", number, float(time_s)) for number, time_s in enumerate(times_s)]
    taken = Simulation(coming).run(works_s)
    numbers = numbers_of(taken, "left")
    assert (np.diff(numbers) > 0).all()
    for each in taken:
        newest = each.newest["left"]
        assert newest.came_s - times_s[each.numbers["left"]] <= LONGEST_S + 1e-9


@settings(deadline=None)
@given(
    st.floats(0.008, 0.018),
    st.lists(st.floats(0.0, 0.05), min_size=2, max_size=7),
    st.lists(st.integers(2, PICTURES // 4 - 2), max_size=8, unique=True),
    st.randoms(use_true_random=False),
)
def test_cameras_that_lose_pictures_stay_matched_and_cost_the_others_none(step_s, jitter, places, random):
    lost = [(random.choice(NAMES), 4 * place + random.randrange(2)) for place in places]
    taken = Simulation(pictures(step_s, (0.0, 0.0, 0.0), jitter, lost)).run([0.3 * step_s])
    assert all(len(set(each.numbers.values())) == 1 for each in taken)
    for name in NAMES:
        assert numbers_of(taken, name) == [number for number in range(PICTURES) if (name, number) not in lost]


@settings(deadline=None)
@given(st.floats(0.005, 0.012), st.integers(3, 8), st.floats(0.0, 1.0), little, st.floats(0.0, 0.25))
def test_a_slow_camera_neither_costs_a_quick_one_pictures_nor_holds_them_up(
    step_s, times, phase, jitter, share
):
    """Eyes of 80 to 200 pictures a second, beside a mouth that has a third to an eighth of them."""
    mouth = [
        Coming(each.came_s, "mouth", each.number, each.time_s)
        for each in pictures(times * step_s, (phase,), jitter)
    ]
    coming = sorted(pictures(step_s, (0.0,), jitter) + mouth, key=lambda each: each.came_s)
    eyes = [each for each in coming if each.name == "left"]
    taken = Simulation(coming).run([share * step_s])
    known = [each for each in taken if each.at_s > eyes[3 * times].came_s]  # both cameras' steps by then
    seen = numbers_of(known, "left")
    assert seen == list(range(seen[0], PICTURES))
    came = {each.number: each.came_s for each in eyes}
    late_s = [each.at_s - came[each.numbers["left"]] for each in known if "left" in each.numbers]
    assert max(late_s) <= (0.75 + times * max(jitter) + share) * step_s + 1e-9


@settings(deadline=None)
@given(st.floats(0.005, 0.012), st.integers(2, 6), st.floats(0.1, 0.9), st.floats(0.05, 0.4))
def test_a_slow_camera_that_is_overdue_costs_a_quick_one_no_picture(step_s, times, phase, stalls_s):
    slow = pictures(times * step_s, (phase,), [0.0])
    slow = [Coming(each.came_s, "mouth", each.number, each.time_s) for each in slow]
    eyes = pictures(step_s, (0.0,), [0.0])
    since_s = eyes[PICTURES // 2].came_s
    late = [each for each in slow if not since_s <= each.came_s < since_s + stalls_s]
    taken = Simulation(sorted(eyes + late, key=lambda each: each.came_s)).run([0.2 * step_s])
    seen = [number for number in numbers_of(taken, "left") if eyes[number].came_s > since_s]
    assert seen == list(range(seen[0], PICTURES))


@settings(deadline=None)
@given(st.floats(0.008, 0.012), little, st.integers(5, 40), st.floats(0.0, 0.015))
def test_one_camera_whose_thread_sleeps_costs_no_picture(step_s, jitter, at, pause_s):
    coming = pictures(step_s, (0.0, 0.0, 0.0), jitter)
    since_s = (1 + at) * step_s
    late = [
        Coming(max(each.came_s, since_s + pause_s), each.name, each.number, each.time_s)
        if each.name == "mouth" and since_s <= each.came_s < since_s + pause_s
        else each
        for each in coming
    ]
    taken = Simulation(sorted(late, key=lambda each: each.came_s)).run([0.3 * step_s])
    assert all(len(set(each.numbers.values())) == 1 for each in taken)
    for name in NAMES:
        assert numbers_of(taken, name) == list(range(PICTURES))


@settings(deadline=None)
@given(
    st.lists(st.integers(1, 25), min_size=1, max_size=5),
    st.floats(0.11, 0.9),
    st.floats(0.0, 0.004),
    st.lists(st.floats(0.75, 1.0), min_size=1, max_size=5),
)
def test_pictures_that_come_in_bursts_are_not_late(counts, gap_s, within_s, shares):
    """As over Wi-Fi: most steps are next to nothing, and say nothing of the wait for the next burst."""
    bursts, begun_s = [], 0.0
    for number in range(12):
        begun_s += gap_s * shares[number % len(shares)]
        for _ in range(counts[number % len(counts)]):
            bursts.append(Coming(begun_s, "mouth", len(bursts), begun_s))
            begun_s += within_s + 1e-5
    eyes = [
        Coming(0.02 * number, "left", number, 0.02 * number) for number in range(1, round(begun_s / 0.02))
    ]
    taken = Simulation(sorted(bursts + eyes, key=lambda each: each.came_s)).run([0.001])
    since_s = 4 * (gap_s + 25 * within_s)  # a few bursts say how far they are apart
    known = [each for each in taken if since_s < each.at_s < begun_s]
    assert known
    assert not any(each.faults for each in known)


def test_one_pause_makes_nobody_wait_longer_for_a_camera():
    backlog = Backlog()
    times_s = np.cumsum([1 / 30] * 60 + [0.3] + [1 / 30] * 10)
    for time_s in times_s:
        backlog.add(Picture(time_s=time_s), time_s)
    assert backlog.gap_s < 0.04


def test_a_line_in_which_nobody_looks_holds_what_came_lately_alone():
    backlog = Backlog()
    for number in range(1000):
        backlog.add(Picture(time_s=number / 1000), number / 1000)
    assert len(backlog) == 51
    assert backlog.time_s == 0.949
