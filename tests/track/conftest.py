"""MediaPipe's model file, which a clone does not hold."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from facegen.errors import MissingAsset


@pytest.fixture(scope="session")
def detector_file() -> Path:
    """The pinned file, fetched once a machine."""
    from track.detectors.model_file import model_file

    try:
        return model_file()
    except MissingAsset as reason:
        pytest.skip(str(reason))


@pytest.fixture
def detector(detector_file: Path) -> Iterator:
    """MediaPipe, new for each test, as it remembers faces."""
    from track.detectors import MediapipeDetector

    made = MediapipeDetector(detector_file)
    yield made
    made.close()
