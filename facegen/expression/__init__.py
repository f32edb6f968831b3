"""Faces as 52 weights: components that draw them, templates, and couplings that all keep; of no spec and no rig."""

from facegen.expression.components import COMPONENTS, UNMIXED, Component
from facegen.expression.couplings import restrain
from facegen.expression.templates import load_emotions, load_templates

__all__ = [
    "COMPONENTS",
    "UNMIXED",
    "Component",
    "load_emotions",
    "load_templates",
    "restrain",
]
