"""What a person reads of a session's speed: of the last frames, and not reckoned anew for each."""

from track.session import measures
from track.session.measures import REMEMBERED, SHOWN_EVERY_S, Measures


def test_figures_are_of_the_last_frames_and_reckoned_a_few_times_a_second(monkeypatch):
    asked = []
    plain = measures.quantiles_ms
    monkeypatch.setattr(
        measures, "quantiles_ms", lambda seconds: asked.append(len(seconds)) or plain(seconds)
    )
    found = Measures(remembered=10 * REMEMBERED)
    for number in range(4 * REMEMBERED):
        found.frame(number / 120, [0.1 if number < 2 * REMEMBERED else 0.004])
        fps, latency_ms = found.shown(number / 120)
    assert latency_ms == {"p50": 4.0, "p95": 4.0, "p99": 4.0}
    assert abs(fps - 120) < 1
    assert max(asked) == REMEMBERED
    assert len(asked) <= 4 * REMEMBERED / 120 / SHOWN_EVERY_S + 1
    assert found.latency_ms()["p95"] == 100.0
    assert found.shown(4 * REMEMBERED / 120 + 10)[0] == 0.0  # the cameras are away
