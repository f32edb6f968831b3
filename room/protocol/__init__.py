"""What goes over the wire: the state of a person, a tick of the room, and the texts of a meeting."""

from room.protocol.message import MESSAGE_BYTES, Animation, Flag, Message, check, decode, encode

__all__ = ["MESSAGE_BYTES", "Animation", "Flag", "Message", "check", "decode", "encode"]
