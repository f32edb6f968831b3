"""Defines ``facegen spec check | show | schema | reference | labels``."""

import json
import sys
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import counted, say

spec_app = typer.Typer(help="Specs: what a dataset is, in TOML.", no_args_is_help=True)


@spec_app.command()
def check(spec: Annotated[Path, typer.Argument(help="A spec, for example datasets/default.toml.")]) -> None:
    """Say whether a spec can be used, with the rig and the headset that it names, and how much it makes.

    Example: facegen spec check datasets/default.toml
    """
    from facegen.sessions import check_layout
    from facegen.spec import idle_note, load_spec, sample_ranges
    from facegen.store import resolve

    checked = load_spec(spec)
    dataset = resolve(checked, Path())
    plan = dataset.plan
    rendered = len(sample_ranges(checked.render.samples, total=plan.samples, where=f"{spec}: render.samples"))
    check_layout(checked, dataset.rigs, dataset.headset, rendered=rendered)
    people, samples = counted(checked.people, "person", "people"), counted(plan.samples, "sample")
    print(f"{spec}: good; {people}, {samples}, {rendered} of them rendered")
    if note := idle_note(checked):
        say(f"facegen: {spec}: {note}")


@spec_app.command()
def show(spec: Annotated[Path, typer.Argument(help="A spec, for example datasets/default.toml.")]) -> None:
    """Print the resolved spec, defaults filled in, as JSON.

    Example: facegen spec show datasets/tiny.toml
    """
    from facegen.spec import load_spec, spec_table

    json.dump(spec_table(load_spec(spec)), sys.stdout, indent=2)
    print()


@spec_app.command()
def schema() -> None:
    """Print the JSON schema of a spec, for editors that check TOML.

    Example: facegen spec schema > spec.schema.json
    """
    from facegen.spec import spec_schema

    json.dump(spec_schema(), sys.stdout, indent=2)
    print()


@spec_app.command()
def reference() -> None:
    """Print every key of a spec with unit, allowed values, default and meaning, as Markdown: the page docs/spec.md.

    Example: facegen spec reference > docs/spec.md
    """
    from facegen.spec import spec_reference

    print(spec_reference(), end="")


@spec_app.command()
def labels() -> None:
    """Print every label of a sample with shape, unit and meaning, as Markdown: the page docs/labels.md.

    Example: facegen spec labels > docs/labels.md
    """
    from facegen.store import labels_reference

    print(labels_reference(), end="")
