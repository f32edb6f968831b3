"""The inside of the mouth: teeth, gums, palate and tongue of our own, for rigs that have none that bear a close look."""

from facegen.mouth.interior import MOUTH_PARTS, has_own_teeth, mouth_meshes
from facegen.mouth.traits import MouthTraits, draw_mouth

__all__ = ["MOUTH_PARTS", "MouthTraits", "draw_mouth", "has_own_teeth", "mouth_meshes"]
