"""Pictures of datasets for people to look at."""

from facegen.preview.sheet import contact_sheet

__all__ = ["contact_sheet"]
