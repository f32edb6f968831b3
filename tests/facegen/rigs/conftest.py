"""Rigs that the tests of this folder share."""

import os
import tarfile
from pathlib import Path

import pytest

from facegen.rigs import Rig, load_rig
from facegen.rigs.building import RIGS, add_rig, build_rig
from tests.facegen.rigs.glb_head import write_head


@pytest.fixture(scope="session")
def ict_clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sample of a clone of ICT-FaceKit that lies beside the project."""
    beside = Path(__file__).resolve().parents[4] / "shared" / "real"
    archive = Path(os.environ.get("FACEGEN_REAL", beside)) / "ict-facekit-24.tar.xz"
    if not archive.is_file():
        pytest.skip(f"{archive} is not there; FACEGEN_REAL names the folder of real recordings")
    folder = tmp_path_factory.mktemp("ict")
    with tarfile.open(archive) as tar:
        # Python knows filters from 3.11.4 on; Debian 12 has 3.11.2
        tar.extractall(folder, **({"filter": "data"} if hasattr(tarfile, "data_filter") else {}))
    return folder / "ICT-FaceKit"


@pytest.fixture(scope="session")
def ict(ict_clone: Path) -> Rig:
    """The ICT rig, of all modes that the sample has."""
    build_rig("ict", path=ict_clone, folder=ict_clone.parent)
    return load_rig("ict", ict_clone.parent)


@pytest.fixture(scope="session")
def glb(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> Rig:
    """Anny's mean head, taken through a glTF file as a user's would be; its lid margins are found on the mesh."""
    folder = tmp_path_factory.mktemp("glb")
    add_rig(*write_head(anny, folder), name="glb", folder=folder)
    return load_rig("glb", folder)


@pytest.fixture(params=[*RIGS, "glb"])
def rig(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Rig:
    """Each rig in turn; one without a fixture of its own is built as `facegen rig build` does without options."""
    if request.param in ("anny", "ict", "glb"):
        return request.getfixturevalue(request.param)
    folder = tmp_path_factory.mktemp(request.param)
    build_rig(request.param, folder=folder)
    return load_rig(request.param, folder)
