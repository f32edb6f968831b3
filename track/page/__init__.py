"""The page in the browser: a small server on this machine, and what it shows."""

from track.page.server import Page

__all__ = ["Page"]
