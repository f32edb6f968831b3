"""Sensors: from linear radiance to the grey levels that a headset's driver delivers, as often as one likes."""

from facegen.sensor.development import develop
from facegen.sensor.view import develop_view

__all__ = ["develop", "develop_view"]
