"""How faces move: clips of smooth motion, each decided by (spec, number of the clip) alone."""

from facegen.sampling.motion.kinds import CLIP_KINDS
from facegen.sampling.motion.script import Script, write_script
from facegen.sampling.motion.takes import Take, draw_take, draw_takes

__all__ = ["CLIP_KINDS", "Script", "Take", "draw_take", "draw_takes", "write_script"]
