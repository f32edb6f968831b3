"""Readers of data sets and farm jobs stand all mutators."""

import pytest

from tests.hostile.plan import pairs
from tests.hostile.readers.datasets import READERS
from tests.hostile.trial import HONEST, Case

pytestmark = pytest.mark.slow

TABLE = {reader.name: reader for reader in READERS}


@pytest.mark.parametrize("name", TABLE)
def test_honest_input(attempt, name):
    outcome = attempt(Case(reader=TABLE[name], mutator=HONEST, seed=0))
    assert outcome.verdict.kind == TABLE[name].honest, (outcome.verdict, outcome.stderr)


@pytest.mark.parametrize(
    ("name", "mutator"), [pytest.param(r.name, m, id=f"{r.name}-{m}") for r, m in pairs(TABLE)]
)
def test_damaged_input(stand, name, mutator):
    stand(TABLE[name], mutator)
