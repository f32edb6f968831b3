"""Makes the few SVG elements of the report's figures."""

from collections.abc import Sequence
from html import escape


def line(x1: float, y1: float, x2: float, y2: float, kind: str) -> str:
    """A line of one of the page's classes."""
    return f'<line class="{kind}" x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}"/>'


def text(x: float, y: float, content: str, kind: str) -> str:
    """A text whose base line begins, ends or is centred at a place, by its class."""
    return f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}">{escape(content)}</text>'


def upright_text(x: float, y: float, content: str, kind: str) -> str:
    """The same, read from below."""
    return f'<text class="{kind}" transform="translate({x:.1f} {y:.1f}) rotate(-90)">{escape(content)}</text>'


def picture(width: float, height: float, parts: Sequence[str], description: str) -> str:
    """The whole figure, as wide as the page allows."""
    named = f'role="img" aria-label="{escape(description, quote=True)}"'
    return f'<svg viewBox="0 0 {width:.0f} {height:.0f}" {named}>{"".join(parts)}</svg>'
