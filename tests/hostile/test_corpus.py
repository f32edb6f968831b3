"""What once failed does so no more."""

import pytest

from tests.hostile import corpus
from tests.hostile.readers import READERS
from tests.hostile.trial import HONEST, Case

pytestmark = pytest.mark.slow

FILES = list(corpus.kept_files())
CASES = list(corpus.kept_cases())


@pytest.mark.parametrize(
    ("case", "path"), FILES, ids=[f"{case.reader.name}-{path.name}" for case, path in FILES]
)
def test_kept_files_end_well(attempt, case, path):
    outcome = attempt(case, replay=path.read_bytes())
    assert outcome.verdict.good, (outcome.verdict, outcome.stderr)


@pytest.mark.parametrize("case", CASES, ids=str)
def test_kept_cases_end_well(attempt, case):
    outcome = attempt(case)
    assert outcome.verdict.good, (outcome.verdict, outcome.stderr)


def test_a_failure_is_made_small_and_kept(attempt, monkeypatch, tmp_path):
    monkeypatch.setattr(corpus, "FOLDER", tmp_path / "corpus")
    case = Case(reader=READERS["rig-json"], mutator=HONEST, seed=0)
    deep = b"[" * 3_000 + b'{"name": 1}' + b"]" * 3_000
    broken = {"broken": "tests.hostile.rogues:unbounded_json"}
    outcome = attempt(case, replay=deep, **broken)
    assert not outcome.verdict.good
    corpus.keep(outcome, deep, lambda data: attempt(case, replay=data, **broken))
    [(kept, path)] = corpus.kept_files()
    assert kept.reader is case.reader
    assert len(path.read_bytes()) < len(deep)
    assert attempt(kept, replay=path.read_bytes()).verdict.good
