"""Lists the engines by the name that ``--engine`` takes."""

from facegen.farm.engine import Engine
from facegen.farm.openjd import OpenJD
from facegen.farm.slurm import Slurm

ENGINES: dict[str, Engine] = {"slurm": Slurm(), "openjd": OpenJD()}
