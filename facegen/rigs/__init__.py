"""Rigs: heads linear in identity and expression, with eyes, lids and landmarks; built, stored, evaluated."""

from facegen.rigs.callipers import measures_mm
from facegen.rigs.evaluation import EvaluatedFaces, evaluate
from facegen.rigs.eyes import EyeGeometry, eye_geometry, lid_support_radius, visual_axis
from facegen.rigs.files import load_rig, save_rig
from facegen.rigs.licence import licence_text
from facegen.rigs.lid_margins import lid_gap, lid_margins, open_lid_gap
from facegen.rigs.neutral import eye_centers, neutral_landmarks
from facegen.rigs.occluder import FaceOccluder, closed_cage, occluder
from facegen.rigs.record import rigs_folder
from facegen.rigs.rig import Rig

__all__ = [
    "EvaluatedFaces",
    "EyeGeometry",
    "FaceOccluder",
    "Rig",
    "closed_cage",
    "evaluate",
    "eye_centers",
    "eye_geometry",
    "licence_text",
    "lid_gap",
    "lid_margins",
    "lid_support_radius",
    "load_rig",
    "measures_mm",
    "neutral_landmarks",
    "occluder",
    "open_lid_gap",
    "rigs_folder",
    "save_rig",
    "visual_axis",
]
