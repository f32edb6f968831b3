"""Errors that whoever holds a meeting can meet: those of the ground, `facegen.errors`.

::

    InputError            2   an address, a certificate, a room or a record that cannot be used
    FormatError           2   bytes or a text that are no message of the room
    OutputError          74   a record that cannot be written
"""

from facegen.errors import FormatError, InputError, OutputError

__all__ = ["FormatError", "InputError", "OutputError"]
