"""Errors that whoever holds a meeting can meet: those of the ground, `facegen.errors`, and one of the room's own.

::

    InputError            2   an address, a certificate, a room or a record that cannot be used
    ├── FormatError       2   bytes or a text that are no message of the room
    └── NotAllowed        2   what the room's rules forbid to a person; told to them alone
    OutputError          74   a record that cannot be written
"""

from facegen.errors import FormatError, InputError, OutputError

__all__ = ["FormatError", "InputError", "NotAllowed", "OutputError"]


class NotAllowed(InputError):
    """What the room's rules forbid to a person.

    Parameters
    ----------
    text
        The sentence that the person reads.
    again
        Whether the same may be allowed a little later.
    """

    def __init__(self, text: str, *, again: bool = False) -> None:
        super().__init__(text)
        self.again = again
