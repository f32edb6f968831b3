"""What browsers get is what the sources give, is small, and agrees with what Python knows."""

import json
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from facegen.conventions import BLENDSHAPES
from facegen.documents import load_toml
from track.page import commands, frames
from track.page.server import FILES, STATIC

ROOT = Path(__file__).resolve().parents[3]
WEB = ROOT / "web"
LARGEST_BYTES = 900_000
"""Of the script: on this machine nobody waits for it, and a telephone in the same house takes half a second."""

needs_node = pytest.mark.skipif(
    not ((WEB / "node_modules").exists() and shutil.which("node")),
    reason="web/node_modules is not there: `npm ci` in web makes it",
)


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("built")
    subprocess.run(["node", "build.mjs", "--out", str(folder)], cwd=WEB, check=True, capture_output=True)
    return folder


def _node(script: str) -> object:
    """What a module prints as JSON that may import the sources of web."""
    bundle = subprocess.run(
        ["node_modules/.bin/esbuild", "--bundle", "--format=esm", "--platform=node", "--log-level=error"],
        **{"cwd": WEB, "input": script, "check": True, "capture_output": True, "text": True},
    )
    ran = subprocess.run(
        ["node", "--input-type=module"], input=bundle.stdout, check=True, capture_output=True, text=True
    )
    return json.loads(ran.stdout)


@pytest.fixture(scope="module")
def kept() -> Callable[[str], bytes]:
    """How a bundle of the repository is read: as it was committed, where the sources stand as they were.

    CI bundles anew before it tests, so its files would be compared with themselves.
    """

    def git(*words: str) -> subprocess.CompletedProcess:
        return subprocess.run(["git", *words], cwd=ROOT, capture_output=True, check=False)

    changed = git("status", "--porcelain", "--", "web")
    if changed.returncode or changed.stdout:  # no clone, or sources that somebody works on
        return lambda path: (ROOT / path).read_bytes()
    return lambda path: git("show", f"HEAD:{path}").stdout


@needs_node
@pytest.mark.parametrize("folder", ["track/page/static", "room/server/static"])
def test_the_sources_give_these_bytes(folder, built, kept):
    made = sorted(path for path in (built / folder).iterdir() if path.is_file())
    changed = [path.name for path in made if path.read_bytes() != kept(f"{folder}/{path.name}")]
    assert changed == [], "run `make web`, and commit what it makes"


@needs_node
def test_each_page_has_what_it_asks_for(built):
    assert {path.name for path in (built / "track/page/static").iterdir()} == set(FILES.values())
    # the rest of the room's files lies in folders, which others make
    files = {path.name for path in (ROOT / "room/server/static").iterdir() if path.is_file()}
    assert {path.name for path in (built / "room/server/static").iterdir()} == files


@needs_node
def test_the_sources_are_typed():
    subprocess.run(["node_modules/.bin/tsc", "--noEmit"], cwd=WEB, check=True)


@needs_node
def test_shapes_and_presets_are_those_of_python():
    script = """
        import { SHAPES, shapeIndex } from "./avatar/shapes.js";
        import { PRESETS } from "./avatar/expressions.js";
        const spellings = ["JawOpen", "jaw_open", "eyeBlink_L", "EYEBLINKRIGHT", "blendShape1.mouthSmile_R",
          "browInnerUp", "jaw_left", "jawL", "jawOpenWide", "Fcl_MTH_A", "", "L"];
        const found = spellings.map((each) => SHAPES[shapeIndex(each)] ?? null);
        console.log(JSON.stringify({ SHAPES, PRESETS, found }));
    """
    told = _node(script)
    assert told["SHAPES"] == list(BLENDSHAPES)
    found = [
        "jawOpen",
        "jawOpen",
        "eyeBlinkLeft",
        "eyeBlinkRight",
        "mouthSmileRight",
        "browInnerUp",
        "jawLeft",
    ]
    assert told["found"] == [*found, None, None, None, None, None]
    table = load_toml(ROOT / "regress/runtime/stages/retargeting/targets/vrm1.toml")["shapes"]
    looks = {name: factors for name, factors in table.items() if factors and not name.startswith("look")}
    assert looks == told["PRESETS"]


@needs_node
def test_both_sides_speak_the_same_version():
    assert _node('import { VERSION } from "./track/messages.js"; console.log(VERSION);') == frames.VERSION


def test_the_script_is_small_and_asks_no_one_else():
    script = (STATIC / "page.js").read_text()
    assert len(script.encode()) < LARGEST_BYTES
    assert not re.search(r"\beval\(|new Function\(|innerHTML|document\.write", script)
    assert "sourceMappingURL" not in script
    page = (STATIC / "index.html").read_text()
    assert "http" not in page
    assert not re.search(r"<script(?! type=\"module\" src=\"page\.js\")|<style| style=| on\w+=", page)


def test_licences_of_all_that_is_bundled_lie_beside_it():
    text = (STATIC / "LICENSES.txt").read_text()
    for name in ("three 0.187.0 (MIT)", "@pixiv/three-vrm 3.5.5 (MIT)"):
        assert name in text
    assert text.count("THE SOFTWARE IS PROVIDED") == 2


def test_versions_are_exact_and_name_no_registry():
    package = json.loads((WEB / "package.json").read_text())
    versions = [*package["dependencies"].values(), *package["devDependencies"].values()]
    assert [each for each in versions if not re.fullmatch(r"\d+\.\d+\.\d+(-[\w.]+)?", each)] == []
    assert "resolved" not in (WEB / "package-lock.json").read_text()


def test_sliders_stay_within_what_the_server_takes():
    largest = re.search(r"LARGEST_GAIN = ([\d.]+)", (WEB / "track/weights.ts").read_text())
    assert float(largest[1]) <= commands.MOST_GAIN
