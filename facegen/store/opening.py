"""Opens datasets on disk, and resolves specs: what they name is loaded, and hashed."""

import dataclasses
import hashlib
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np
from pydantic import TypeAdapter, ValidationError

from facegen.errors import InputError, MissingAsset
from facegen.headsets import Headset, load_headset
from facegen.refusals import refusal
from facegen.rigs import load_rig
from facegen.sampling import plan_dataset
from facegen.sessions import check_base
from facegen.spec import LABEL_VERSION, Spec, load_spec, shares_of, spec_hash
from facegen.store.dataset import Dataset, otherwise_built, rigs_of
from facegen.store.description import read_description
from facegen.store.folder import DatasetFolder

_Asset = TypeVar("_Asset")

DRAWN = "drawn"
"""Name of the headset of a dataset whose people each wear another one."""


def resolve(spec: Spec, out: str | Path) -> Dataset:
    """A spec with its assets loaded; reads, writes nothing.

    Raises
    ------
    InputError
        If the rig, the headset or the recording is missing or damaged, or the pictures get too large.
    """
    plan = plan_dataset(spec)
    rigs = tuple(_asset("rig", load_rig, name) for name in shares_of(spec.rig))
    headset = _asset("render.headset", load_headset, spec.render.headset)
    if spec.layout is not None:
        check_base(headset)
    assets = {
        **({"rig": rigs[0].sha256} if len(rigs) == 1 else {f"rig {rig.name}": rig.sha256 for rig in rigs}),
        "headset": _content_sha256(_headset_content(headset)),
    }
    # datasets of before held weights of shapes that their rig lacks
    assets |= {f"unseen {rig.name}": str(rig.unseen) for rig in rigs if rig.unseen}
    if plan.recording is not None:
        assets["recording"] = hashlib.sha256(np.ascontiguousarray(plan.recording).tobytes()).hexdigest()
    return Dataset(
        folder=DatasetFolder(Path(out)),
        plan=plan,
        rigs=rigs,
        headset=_scaled(_named(headset, spec), spec.render.size_px),
        hash=spec_hash(spec, asset_sha256=assets),
    )


def _asset(key: str, load: Callable[[str], _Asset], name: str) -> _Asset:
    """What a spec names; where there is no such thing, the key begins the sentence."""
    try:
        return load(name)
    except MissingAsset as error:
        raise MissingAsset(f"{key}: {error}") from None


def open_dataset(path: str | Path) -> Dataset:
    """Open a dataset on disk.

    Raises
    ------
    InputError
        If there is none, or its spec, rig, headset or labels are no longer those that it was made with.
    """
    folder = DatasetFolder(Path(path))
    described = read_description(folder)
    for needed in (folder.spec_toml, folder.headset_toml):
        if not os.path.lexists(needed):
            raise InputError(
                f"{needed}: is missing; facegen generate SPEC --out {path}, with the spec that the dataset was made "
                f"of, writes it again"
            )
    spec = load_spec(folder.spec_toml)
    dataset = resolve(spec, path)
    if dataset.hash != described["spec_hash"]:
        raise InputError(f"{path}: {_otherness(dataset, described)}")
    return dataset


def _otherness(dataset: Dataset, described: dict) -> str:
    """What of a dataset is no longer as ``dataset.json`` has it, and what to do."""
    if described["label_version"] != LABEL_VERSION:
        return (
            f"has labels of version {described['label_version']}, and this version of facegen makes and reads "
            f"{LABEL_VERSION}; make the dataset anew, or read it with the facegen "
            f"that made it ({described['versions'].get('facegen', 'of then')}, by its commit)"
        )
    if built := otherwise_built(dataset, described):
        return built
    if any(described.get(key, about) != about for key, about in rigs_of(dataset).items()):
        rigs = " or ".join(map(repr, shares_of(dataset.spec.rig)))
        return f"was made with another version of rig {rigs}; build that again, or make the dataset anew"
    return (
        "its spec.toml or headset.toml was changed after it was made; facegen generate SPEC --out "
        f"{dataset.folder.path}, with the spec that it was made of, writes spec.toml again, and headset.toml is a copy "
        "of what that spec names"
    )


def _headset_content(headset: Headset) -> dict:
    """What a headset's file says, for the hash; a key younger than some datasets stays out where it changes nothing."""
    content = TypeAdapter(Headset).dump_python(headset, mode="json")
    for camera in content["cameras"]:
        if camera["lens"]["blur"] == 0:
            del camera["lens"]["blur"]
    return content


def _named(headset: Headset, spec: Spec) -> Headset:
    """The headset that a spec names; where it is drawn anew for each person, it is called so."""
    return headset if spec.layout is None else dataclasses.replace(headset, name=DRAWN)


def _scaled(headset: Headset, size_px: int) -> Headset:
    for camera in headset.cameras:
        try:
            camera.scaled(size_px)
        except ValidationError as error:
            height = f"{camera.height * size_px / camera.width:.0f}"
            raise InputError(
                f"render.size_px = {size_px}: camera {camera.name!r} of headset {headset.name!r} has "
                f"{camera.width} x {camera.height} px and would have {size_px} x {height}, which is not allowed "
                f"({refusal(error, type(camera))}); choose another size"
            ) from None
    return headset.scaled(size_px)


def _content_sha256(content: object) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
