"""Says how every table of a spec is checked, and how a key's distribution is given a default."""

from dataclasses import field
from typing import Annotated

from pydantic import ConfigDict, Field

from facegen.spec.distribution import Distribution, parse

STRICT = ConfigDict(extra="forbid", strict=True, use_attribute_docstrings=True)
"""Every key's docstring is its line in docs/spec.md and in the JSON schema."""

Share = Annotated[float, Field(ge=0, le=1, json_schema_extra={"x-unit": "share"})]


def default(value: object) -> Distribution:
    """Default of a distribution's key, as TOML would have it."""
    return field(default_factory=lambda: parse(value))
