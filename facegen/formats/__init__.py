"""Readers and writers of other programs' files, for both packages: NumPy and the format's library only."""

from facegen.errors import FormatError
from facegen.formats.live_link import LiveLinkTake, live_link_csv, read_live_link
from facegen.formats.points import read_pts, write_pts

__all__ = ["FormatError", "LiveLinkTake", "live_link_csv", "read_live_link", "read_pts", "write_pts"]
