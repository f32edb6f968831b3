"""Errors that whoever holds a meeting can meet: those of the ground, `facegen.errors`.

::

    InputError            2   an address, a certificate, a room or a record that cannot be used
    OutputError          74   a record that cannot be written
"""

from facegen.errors import InputError, OutputError

__all__ = ["InputError", "OutputError"]
