"""Rigs that the tests of this folder share."""

import os
import tarfile
from pathlib import Path

import pytest

from facegen.rigs import Rig, load_rig
from facegen.rigs.building import build_rig


@pytest.fixture(scope="session")
def ict(tmp_path_factory: pytest.TempPathFactory) -> Rig:
    """The ICT rig, built from the sample of a clone that lies beside the project."""
    beside = Path(__file__).resolve().parents[4] / "shared" / "real"
    archive = Path(os.environ.get("FACEGEN_REAL", beside)) / "ict-facekit-24.tar.xz"
    if not archive.is_file():
        pytest.skip(f"{archive} is not there; FACEGEN_REAL names the folder of real recordings")
    folder = tmp_path_factory.mktemp("ict")
    with tarfile.open(archive) as tar:
        tar.extractall(folder, filter="data")
    build_rig("ict", path=folder / "ICT-FaceKit", folder=folder)
    return load_rig("ict", folder)


@pytest.fixture(params=["anny", "ict"])
def rig(request: pytest.FixtureRequest) -> Rig:
    """Each rig in turn."""
    return request.getfixturevalue(request.param)
