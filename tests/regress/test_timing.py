"""``regress bench``: every way to run a model is timed, or says why not."""

import json

from regress import timing


def test_bench_times_each_way_or_says_why_not(run, quick_model_folder, monkeypatch):
    monkeypatch.setattr(timing, "BATCH_FRAMES", 200)
    monkeypatch.setattr(timing.shutil, "which", lambda tool: None)
    code, out, err = run("bench", quick_model_folder, "--json")
    assert code == 0, err
    timings = {entry["name"]: entry for entry in json.loads(out)}
    assert list(timings) == [
        "NumPy, one frame",
        "NumPy, 200 frames",
        "fast, one frame",
        "fast, 200 frames",
        "fast, 200 frames, all cores",
        "ONNX, one frame",
        "C, one frame",
        "JavaScript, one frame",
    ]
    for name, entry in timings.items():
        if name.startswith(("NumPy", "fast", "ONNX")):
            assert 0 < entry["microseconds"] < 1e6
        else:
            assert entry["microseconds"] is None
            assert "on this machine" in entry["note"]


def test_the_base_installation_times_all_but_onnx(run, quick_model_folder, monkeypatch):
    monkeypatch.setattr(timing, "BATCH_FRAMES", 200)
    monkeypatch.setattr(timing, "find_spec", lambda name: None)
    code, out, err = run("bench", quick_model_folder, "--json")
    assert code == 0, err
    (onnx,) = (entry for entry in json.loads(out) if entry["name"].startswith("ONNX"))
    assert onnx["microseconds"] is None
    assert "learn extra" in onnx["note"]


def test_bench_prints_a_line_each(run, quick_model_folder, monkeypatch):
    monkeypatch.setattr(timing, "BATCH_FRAMES", 200)
    code, out, err = run("bench", quick_model_folder)
    assert code == 0, err
    assert len(out.splitlines()) == 8
    assert "failed" not in out
