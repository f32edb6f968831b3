"""Brings together what several processes know of one room, so that all of them come to know the same.

Accounts may come in any order, and more than once. Of two places of one person the later entry counts, and of mutes and
locks the latest act. Of two people with one number the smaller id keeps it. Who was removed by one is removed by all,
and whose own avatar one took off brings none to any.
"""

from dataclasses import dataclass, field

from room.protocol.accounts import Account, Mute, Resident
from room.protocol.answers import Changed, Door, Left
from room.state.meeting import Meeting
from room.state.seat import Seat

SILENT_S = 6.0
"""A process that says nothing for so long has ended: its people are away. It speaks three times in this time."""


@dataclass(frozen=True, kw_only=True)
class Ousted:
    """Somebody of this process who has to go, as the others know better.

    Parameters
    ----------
    id
        Of the person.
    text
        What they are told.
    again
        Whether their page comes back by itself.
    """

    id: str
    text: str
    again: bool


@dataclass(kw_only=True)
class Merged:
    """What an account changed.

    Parameters
    ----------
    told
        What the people of this process have to hear.
    ousted
        Those of them who have to go.
    undressed
        Ids of those of them whose own avatar was taken off elsewhere.
    """

    told: list[Changed | Left | Door] = field(default_factory=list)
    ousted: list[Ousted] = field(default_factory=list)
    undressed: list[str] = field(default_factory=list)


def account(meeting: Meeting, *, asks: bool = False) -> Account:
    """All that this process knows of a room."""
    return Account(
        process=meeting.process,
        asks=asks,
        people=tuple(
            _resident(seat) for seat in meeting.seats if seat.home == meeting.process and not seat.replayed
        ),
        mutes=tuple(
            Mute(id=id, muted=muted, acts=acts) for id, (acts, muted) in meeting.rulings.mutes.items()
        ),
        removed=meeting.rulings.removed,
        undressed=meeting.rulings.undressed,
        locked=meeting.locked,
        locks=meeting.lock_acts,
        sharer=meeting.sharer,
        shares=meeting.share_acts,
    )


def merge(meeting: Meeting, said: Account, *, now: float) -> Merged:
    """Take what another process knows. ``now`` in the room's seconds."""
    merged = Merged()
    _rule(meeting, said, merged)
    if (said.locks, said.locked) > (meeting.lock_acts, meeting.locked):
        changed = said.locked != meeting.locked
        meeting.lock_acts, meeting.locked = said.locks, said.locked
        if changed:
            merged.told.append(Door(locked=said.locked))
    listed = {resident.id for resident in said.people}
    for seat in meeting.seats:
        if seat.home == said.process and seat.id not in listed:
            _drop(meeting, seat.id, merged)
    for resident in said.people:
        _settle(meeting, resident, said.process, merged, now=now)
    if (said.shares, said.sharer) > (meeting.share_acts, meeting.sharer):
        merged.told += [Changed(person=seat.person) for seat in meeting.screen(said.sharer, acts=said.shares)]
    return merged


def silent(meeting: Meeting, process: str, *, now: float) -> list[Changed]:
    """A process has ended: its people are away, and may come back by another."""
    told = []
    for seat in meeting.seats:
        if seat.home == process and seat.gone_at is None:
            seat.gone_at, seat.voice = now, False
            told.append(Changed(person=seat.person))
    return told


def _rule(meeting: Meeting, said: Account, merged: Merged) -> None:
    """Take what moderators decided elsewhere, also about people who are not here."""
    for id in said.removed:
        if meeting.rulings.remove(id):
            _drop(meeting, id, merged, text="a moderator has removed you from this room")
    for id in said.undressed:
        if meeting.rulings.undress(id) and (seat := meeting.seat(id)) and seat.home == meeting.process:
            merged.undressed.append(id)
    for mute in said.mutes:
        newer, seat = meeting.rulings.mute(mute.id, mute.muted, acts=mute.acts), meeting.seat(mute.id)
        if newer and seat and seat.muted != mute.muted:
            seat.mute(mute.muted)
            merged.told.append(Changed(person=seat.person))


def _resident(seat: Seat) -> Resident:
    return Resident(
        number=seat.number,
        id=seat.id,
        name=seat.name,
        avatar=seat.avatar,
        visit=seat.visit,
        moderator=seat.moderator,
        present=seat.gone_at is None,
        voice=seat.voice,
        entry=seat.entry,
        own=seat.own,
    )


def _settle(meeting: Meeting, resident: Resident, process: str, merged: Merged, *, now: float) -> None:
    """Give somebody of another process their place here, unless a better claim stands against it."""
    if meeting.rulings.is_removed(resident.id):
        return
    seat = meeting.seat(resident.id)
    if seat and (seat.entry, seat.home) > (resident.entry, process):
        return
    rival = meeting.numbered(resident.number)
    if rival and rival.id != resident.id:
        if rival.id < resident.id:
            return  # their own process hears of the rival, and has them come in anew
        _drop(meeting, rival.id, merged, text="the room was joined with another; you come back", again=True)
    if seat and seat.home == meeting.process:
        merged.ousted.append(Ousted(id=seat.id, text="you came in from another window", again=False))
    before = seat.person if seat else None
    if seat and seat.number != resident.number:
        merged.told.append(Left(number=seat.number))
        before = None
    seat = meeting.settle(seat, resident.number, resident.id)
    seat.home, seat.entry = process, resident.entry
    seat.name, seat.avatar, seat.visit = resident.name, resident.avatar, resident.visit
    # an avatar that was taken off here is on in what its own process said before it heard of that
    seat.own = "" if meeting.rulings.is_undressed(seat.id) else resident.own
    seat.moderator, seat.voice, seat.recorded = resident.moderator, resident.voice, False
    if resident.present:
        seat.gone_at = None
    elif seat.gone_at is None:
        seat.gone_at = now
    if seat.person != before:
        merged.told.append(Changed(person=seat.person))


def _drop(meeting: Meeting, id: str, merged: Merged, *, text: str = "", again: bool = False) -> None:
    seat = meeting.seat(id)
    if seat is None:
        return
    meeting.leave(seat)
    merged.told.append(Left(number=seat.number))
    if seat.home == meeting.process:
        merged.ousted.append(Ousted(id=id, text=text, again=again))
