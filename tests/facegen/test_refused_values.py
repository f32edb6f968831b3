"""A refused value is named with its path and what is allowed, for dataclasses and models alike."""

from typing import Annotated

import pytest
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError
from pydantic.dataclasses import dataclass

from facegen.refusals import refusal


@dataclass(frozen=True, kw_only=True, config=ConfigDict(extra="forbid"))
class Lamp:
    power_mw: Annotated[float, Field(ge=0)]
    name: str = ""


@dataclass(frozen=True, kw_only=True, config=ConfigDict(extra="forbid"))
class Rack:
    lamps: tuple[Lamp, ...] = ()
    spare: Lamp | None = None
    size: int = 1


class RackModel(BaseModel):
    model_config = ConfigDict(extra="forbid")

    lamps: list[Lamp] = []
    spare: Lamp | None = None
    size: int = 1


LAMPS_KNOWN = "Known keys here: power_mw, name"


@pytest.mark.parametrize("record", [Rack, RackModel])
@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        ({"size": 2.5}, "size = 2.5: must be a whole number, got a number with a fractional part"),
        ({"size": "x" * 80}, "size: must be a whole number, unable to parse string as an integer"),
        ({"sise": 2}, "unknown key 'sise'; did you mean 'size'? Known keys here: lamps, spare, size"),
        ({"lamps": [{"power_mw": 1}, {"power_mw": -1}]}, "lamps[1].power_mw = -1: must be greater than or"),
        ({"lamps": [{"power": 1}]}, f"unknown key 'lamps[0].power'; did you mean 'power_mw'? {LAMPS_KNOWN}"),
        ({"spare": {"glow": 1, "power_mw": 1}}, f"unknown key 'spare.glow'; {LAMPS_KNOWN}"),
        ({"spare": {}}, "key 'spare.power_mw' is missing"),
        ({"size": "a", "lamps": [{}]}, "key 'lamps[0].power_mw' is missing; size = \"a\": must be"),
        ({"lamps": [{}, {}, {}, {}, {}]}, "key 'lamps[2].power_mw' is missing; and 2 more"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_refused_value_is_told_with_its_place_and_what_may_be_there(record, table, sentence):
    with pytest.raises(ValidationError) as error:
        TypeAdapter(record).validate_python(table)
    assert sentence in refusal(error.value, record)


def test_a_list_that_is_too_short_is_told_without_how_it_was_found():
    class Named(BaseModel):
        names: Annotated[tuple[str, ...], Field(min_length=2)]

    with pytest.raises(ValidationError) as error:
        Named(names=("a",))
    assert refusal(error.value, Named) == 'names = ["a"]: must have at least 2 items, not 1'
