"""Keeps the state of a training between its epochs, for a run that goes on after a stop."""

import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import torch

from facegen.files import output_errors, write_whole
from regress.errors import InputError


def save_checkpoint(path: Path, key: str, state: Mapping[str, Any]) -> None:
    """Write a state that goes on only under the same key.

    Raises
    ------
    OutputError
        Where the file cannot be written.
    """
    content = io.BytesIO()  # which torch.save fills without errors of its own kind where a disk is full
    torch.save({"key": key, **state}, content)
    with output_errors(path):
        path.parent.mkdir(parents=True, exist_ok=True)
    write_whole(path, content.getvalue())


def read_checkpoint(path: Path, key: str, *, of: str, fixed: str) -> dict[str, Any]:
    """The state that was saved under a key.

    Parameters
    ----------
    of
        What was trained, for who reads a refusal.
    fixed
        What the key stands for: with others a training does not go on.

    Raises
    ------
    InputError
        Where the file is no checkpoint, or was saved under another key.
    """
    try:
        state = torch.load(path, weights_only=True)
        saved_key = state["key"]
    except Exception as error:  # whatever a damaged file makes the unpickler raise
        raise InputError(f"{path} is not a checkpoint of {of}: {error}; remove it") from error
    if saved_key != key:
        raise InputError(
            f"{path} is the checkpoint of a training with other {fixed}; remove it, or repeat that training's command"
        )
    return state
