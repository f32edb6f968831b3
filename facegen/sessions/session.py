"""Draws what stays the same in a session: the headset's unit, and the person's looks, accessories and mouth."""

from dataclasses import dataclass
from functools import lru_cache

from facegen.headsets import Headset, draw_unit
from facegen.mouth import MouthTraits, draw_mouth
from facegen.randomness import stream
from facegen.rigs import Rig
from facegen.scene import Look, draw_look, made_up
from facegen.scene.accessories import Accessories, draw_accessories
from facegen.sessions.drawn_headsets import drawn_headset
from facegen.spec import Spec


@dataclass(frozen=True, kw_only=True, eq=False)
class Session:
    """One person's session.

    Attributes
    ----------
    unit
        The unit of the headset that is worn, off by its tolerances.
    look
        The person's materials and hair, with make-up on.
    accessories
        Beard, glasses and make-up that are worn.
    mouth
        The person's teeth, gums and tongue.
    """

    unit: Headset
    look: Look
    accessories: Accessories
    mouth: MouthTraits


@lru_cache(maxsize=8)  # a session's samples stand side by side
def draw_session(
    spec: Spec, rig: Rig, headset: Headset, *, person: int, session: int, female: bool
) -> Session:
    """Draw a person's session.

    Parameters
    ----------
    spec
        Its seed, and how much differs.
    rig
        The rig that hair grows on.
    headset
        As its file has it; a spec with ranges of layouts draws the person's own on it.
    person, session
        Their numbers: looks and mouth belong to the person, the unit to the session, accessories to both.
    female
        Men may have beards, women make-up.
    """
    look = draw_look(stream(spec.seed, "look", person), rig)
    accessories = draw_accessories(
        stream(spec.seed, "accessories", person),
        stream(spec.seed, "session accessories", session),
        rig,
        female=female,
        beard=spec.looks.beard,
        glasses=spec.looks.glasses,
        make_up=spec.looks.make_up,
    )
    return Session(
        unit=draw_unit_of_session(spec, rig, headset, person=person, session=session),
        look=look if accessories.make_up is None else made_up(look, accessories.make_up),
        accessories=accessories,
        mouth=draw_mouth(stream(spec.seed, "mouth", person)),
    )


@lru_cache(maxsize=8)  # checking a new unit takes longer than labelling a view
def draw_unit_of_session(spec: Spec, rig: Rig, headset: Headset, *, person: int, session: int) -> Headset:
    """Draw the unit of a headset that a person wears in a session."""
    worn = drawn_headset(spec, rig, headset, person)
    return draw_unit(worn, stream(spec.seed, "unit", session), scale=spec.sensor.tolerances)
