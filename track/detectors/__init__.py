"""What finds a face: each detector is a stage that gives a sample its 68 points, irises and head, as far as it can."""

from track.detectors.detectors import DETECTORS, Detector, open_detector
from track.detectors.faults import FaceFault
from track.detectors.mediapipe import MediapipeDetector
from track.detectors.points import PointsDetector

__all__ = ["DETECTORS", "Detector", "FaceFault", "MediapipeDetector", "PointsDetector", "open_detector"]
