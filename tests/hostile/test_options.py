"""Values of options and arguments that nobody expects are taken or refused."""

import pytest

from tests.hostile.plan import pairs
from tests.hostile.readers.options import READERS

pytestmark = pytest.mark.slow

TABLE = {reader.name: reader for reader in READERS}


@pytest.mark.parametrize(
    ("name", "mutator"), [pytest.param(r.name, m, id=f"{r.name}-{m}") for r, m in pairs(TABLE)]
)
def test_values_of_options_are_taken_or_refused_in_a_sentence(stand, name, mutator):
    stand(TABLE[name], mutator)
