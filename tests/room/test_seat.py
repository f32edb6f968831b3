"""Who moves a face: a program that stays away for a second gives it back to the page."""

from room.protocol import Message, decode, encode
from room.state.seat import PROGRAM_LASTS_S, Seat


def test_a_program_that_falls_silent_gives_the_face_back():
    seat = Seat(number=3, id="a", name="Ada", avatar="plain", visit="", moderator=False)
    page, program = (encode(Message(weights=(weight, *[0.0] * 51))) for weight in (0.2, 0.8))
    seat.take(page, program=False, now=0.0)
    assert seat.take(program, program=True, now=0.5)
    assert not seat.take(page, program=False, now=0.5 + PROGRAM_LASTS_S)
    assert decode(seat.state).weights[0] > 0.7
    assert seat.take(page, program=False, now=0.51 + PROGRAM_LASTS_S), "others are told that it is the page's"
    assert (seat.face, seat.state) == ("page", page)
