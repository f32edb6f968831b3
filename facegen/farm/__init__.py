"""Makes datasets on many machines: an existing engine schedules, the folder on disk says what is there."""

from facegen.farm.chunks import Chunk, cut_chunks
from facegen.farm.engine import Activity, Engine
from facegen.farm.engines import ENGINES
from facegen.farm.job import STEPS, Job, Submission, parse_steps
from facegen.farm.request import Request, plan_request
from facegen.farm.resources import Resources, parse_path_pair
from facegen.farm.resumption import Resumption, plan_resumption, prepare_resumption
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
    "Request",
    "Resources",
    "Resumption",
    "StepState",
    "Submission",
    "cancel",
    "cut_chunks",
    "engine_logs",
    "farm_state",
    "parse_path_pair",
    "parse_steps",
    "plan_request",
    "plan_resumption",
    "prepare",
    "prepare_resumption",
    "remaining",
    "submit",
]
