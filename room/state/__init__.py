"""What a room knows: who is in it, where and how they are, and what each may do."""

from room.state.meeting import Meeting, identity
from room.state.seat import Seat

__all__ = ["Meeting", "Seat", "identity"]
