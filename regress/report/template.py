"""Fills in the report's page templates."""

from collections.abc import Iterable
from itertools import groupby
from operator import attrgetter
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined


def rendered(template: str, **values: Any) -> str:
    """The text of a template with values filled in and escaped; equal values give equal text."""
    environment = Environment(
        loader=PackageLoader("regress.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["groupby_in_order"] = _groupby_in_order
    return environment.get_template(template).render(**values)


def _groupby_in_order(items: Iterable, attribute: str) -> list[tuple[str, list]]:
    """Runs of equal attributes; jinja's own filter would sort them."""
    return [(key, list(group)) for key, group in groupby(items, key=attrgetter(attribute))]
