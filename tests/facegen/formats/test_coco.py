"""COCO files hold ASCII alone: COCO's own reader opens them in the locale's encoding."""

import json

import numpy as np

from facegen.formats.coco import LabelledImage, write_coco


def test_names_of_any_script_are_written_in_ascii_and_read_back(tmp_path):
    name, licence = "renders/000/000007/\u0153il-\u76ee-\U0001f441.png", "CC BY 4.0, \u00a9 Zo\u00eb"
    image = LabelledImage(
        number=7,
        file_name=name,
        width=96,
        height=96,
        points=np.full((68, 2), 40.0),
        visibility=np.full(68, 2),
    )
    write_coco(tmp_path / "faces.json", lambda: [image], info={"description": name}, licence=licence)
    content = (tmp_path / "faces.json").read_bytes()
    assert content.isascii()
    read = json.loads(content)
    assert read["images"][0]["file_name"] == read["info"]["description"] == name
    assert read["licenses"][0]["name"] == licence
