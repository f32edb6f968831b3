"""The inside of the mouth: teeth, gums, palate and tongue for rigs that have none that bear a close look."""

from facegen.mouth.interior import has_own_teeth, mouth_meshes
from facegen.mouth.traits import MouthTraits, draw_mouth

__all__ = ["MouthTraits", "draw_mouth", "has_own_teeth", "mouth_meshes"]
