"""What the page asks of a session, and what a session tells it, as plain records below both."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from regress.runtime.sample import Sample


@dataclass(frozen=True, kw_only=True)
class Command:
    """Something a person asks for while the session runs: on the page, by a key, or by ``track calibrate``.

    Parameters
    ----------
    verb
        ``calibrate`` (value: name of the step, ``neutral`` first, or ``all``), ``cancel``, ``mirror`` (true or false),
        ``gain`` (shape and value), ``recentre``, ``record`` (true or false), ``picture`` (whether the page wants the
        camera's pictures).
    shape
        ARKit name, of ``gain``.
    value
        As the verb wants it.
    """

    verb: str
    shape: str | None = None
    value: float | bool | str | None = None


@dataclass(frozen=True, kw_only=True)
class Step:
    """Where calibration is.

    Parameters
    ----------
    name
        Of the step, ``"neutral"``, ``"jaw_open"``; of the last one where it is over.
    state
        ``countdown``, ``recording``, ``done``, ``again`` (it was not good; ``text`` says why), ``failed`` (no face was
        good) or ``cancelled`` by the person.
    seconds_left
        Of the countdown or the recording.
    text
        For the person: what to do now, or how it went.
    """

    name: str
    state: str
    seconds_left: float = 0.0
    text: str = ""


@dataclass(frozen=True, kw_only=True, eq=False)
class Moment:
    """What the page shows of one frame.

    Parameters
    ----------
    sample
        Behind the last stage: weights (52,) by ARKit's names, gaze, head, points in pixels of ``pictures``.
    pictures : mapping of (h, w, 3) or (h, w) uint8
        By camera; empty where nobody looks at them.
    points : mapping of (n, 2) float64
        To draw, by camera, in pixels of its picture; a camera without any is left out.
    fps
        Frames a second that came through lately.
    latency_ms
        ``{"p50": ..., "p95": ...}`` from a picture's time to the sinks, lately.
    faults
        What is wrong just now, in words for the person.
    step
        Where calibration is, while it runs.
    said
        The newest sentences about what was asked for, with numbers that rise.
    settings
        What holds now: ``mirror``, ``recording``, ``calibrating``, ``calibrated``, ``profile``, and ``gains`` by shape.
    """

    sample: Sample
    pictures: Mapping[str, np.ndarray] = field(default_factory=dict)
    points: Mapping[str, np.ndarray] = field(default_factory=dict)
    fps: float = 0.0
    latency_ms: Mapping[str, float] = field(default_factory=dict)
    faults: tuple[str, ...] = ()
    step: Step | None = None
    said: tuple[tuple[int, str], ...] = ()
    settings: Mapping[str, object] = field(default_factory=dict)
