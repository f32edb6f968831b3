"""Holds the one version of facegen, regress, track and room, which are installed together."""

__version__ = "1.0.0"
"""pyproject.toml reads it here; CITATION.cff and CHANGELOG.md repeat it (tests/test_install.py)."""
