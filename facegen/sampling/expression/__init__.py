"""How faces move: a mixture of named components, held to what a face can do."""

from facegen.sampling.expression.components import COMPONENT_NAMES, COMPONENTS
from facegen.sampling.expression.couplings import restrain
from facegen.sampling.expression.mixture import Faces, draw_faces
from facegen.sampling.expression.templates import load_emotions, load_templates

__all__ = [
    "COMPONENTS",
    "COMPONENT_NAMES",
    "Faces",
    "draw_faces",
    "load_emotions",
    "load_templates",
    "restrain",
]
