"""Drawn arrays and networks trained on them in a second or two, for the tests of headset networks."""

from pathlib import Path

import pytest

from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from tests.regress.headset.drawn import write_drawn_arrays


@pytest.fixture(scope="session")
def arrays_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_drawn_arrays(tmp_path_factory.mktemp("headset") / "arrays")


@pytest.fixture(scope="session")
def arrays(arrays_folder: Path) -> HeadsetArrays:
    return read_arrays(arrays_folder)
