"""A server and a workshop for all hostile tests of one process."""

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from tests.hostile.known import KNOWN
from tests.hostile.plan import cases_of
from tests.hostile.readers.reader import Reader
from tests.hostile.running import Server
from tests.hostile.trial import Outcome, clear, try_case
from tests.hostile.workshop import Workshop


@pytest.fixture(scope="session")
def server() -> Iterator[Server]:
    serving = Server()
    yield serving
    serving.close()


@pytest.fixture(scope="session")
def workshop(anny, tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    return Workshop(tmp_path_factory.mktemp("workshop"))


@pytest.fixture
def attempt(server: Server, workshop: Workshop, tmp_path: Path) -> Callable[..., Outcome]:
    """Try a case in a folder of its own, which is removed."""

    def call(case, **settings) -> Outcome:
        folder = tmp_path / "case"
        outcome = try_case(case, server, workshop, folder, **settings)
        clear(folder)
        return outcome

    return call


@pytest.fixture
def stand(attempt: Callable[..., Outcome], record_property: Callable[[str, object], None]):
    """Let a reader stand all seeds of a mutator; failures are named with the command that repeats them."""

    def call(reader: Reader, mutator: str) -> None:
        outcomes = [attempt(case) for case in cases_of(reader, mutator)]
        record_property("hostile", [[outcome.case.reader.name, outcome.verdict.kind] for outcome in outcomes])
        failed = [
            f"{outcome.case.command}: {outcome.verdict.kind}: {outcome.verdict.detail}"
            for outcome in outcomes
            if not outcome.verdict.good
        ]
        known = f"{reader.name} {mutator}" in KNOWN
        if failed and known:
            pytest.xfail(f"known: {failed[0]}")
        assert not known, f"{reader.name} {mutator} fails no more: remove it from tests/hostile/known.py"
        assert not failed, "\n".join(failed)

    return call
