"""Reads and checks ``dataset.json``, which says what a dataset is."""

import os
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from facegen.errors import FormatError, InputError
from facegen.refusals import refusal
from facegen.store.folder import DatasetFolder, read_json

FORMAT = 1
"""Version of a dataset's files."""

Text = Annotated[str, Field(max_length=1000)]


class _Description(BaseModel):
    """What programs rely on; further keys tell people where the data come from."""

    model_config = ConfigDict(strict=True, extra="allow")

    format: Annotated[int, Field(ge=FORMAT, le=FORMAT)]
    spec_hash: Annotated[str, Field(pattern="^[0-9a-f]{64}$")]
    label_version: Annotated[int, Field(ge=1, le=1_000_000)]
    licence: Text
    versions: dict[Text, Text]


def read_description(folder: DatasetFolder) -> dict[str, Any]:
    """Content of ``dataset.json``.

    Raises
    ------
    InputError
        If there is no such file, or it is not what `facegen.store.begin` writes.
    """
    path = folder.path
    if not os.path.lexists(folder.dataset_json):
        found = (
            "holds no dataset.json"
            if os.path.isdir(path)
            else "is a file"
            if os.path.isfile(path)
            else "does not exist"
        )
        raise InputError(
            f"{path}: {found}, so it is not a facegen dataset; facegen generate SPEC --out FOLDER makes one"
        )
    content = read_json(folder.dataset_json)
    try:
        _Description.model_validate(content)
    except ValidationError as error:
        raise FormatError(f"{folder.dataset_json}: {refusal(error, _Description)}") from None
    return content
