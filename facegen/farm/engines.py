"""The table of engines."""

from facegen.farm.engine import Engine
from facegen.farm.openjd import OpenJD
from facegen.farm.slurm import Slurm

ENGINES: dict[str, Engine] = {"slurm": Slurm(), "openjd": OpenJD()}
