"""Datasets made on many machines: an existing engine schedules, the folder on disk says what is there."""

from facegen.farm.chunks import Chunk, cut_chunks
from facegen.farm.engine import Activity, Engine
from facegen.farm.engines import ENGINES
from facegen.farm.job import STEPS, Job, Resources, Submission, asked_jobs
from facegen.farm.state import FarmState, StepState, farm_state
from facegen.farm.submission import cancel, engine_logs, prepare, remaining, submit

__all__ = [
    "ENGINES",
    "STEPS",
    "Activity",
    "Chunk",
    "Engine",
    "FarmState",
    "Job",
    "Resources",
    "StepState",
    "Submission",
    "asked_jobs",
    "cancel",
    "cut_chunks",
    "engine_logs",
    "farm_state",
    "prepare",
    "remaining",
    "submit",
]
