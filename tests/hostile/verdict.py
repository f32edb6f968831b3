"""Says of a command that has ended whether it kept what operators are promised."""

import re
import signal
from dataclasses import dataclass

from tests.hostile.running import CPU_S, MEMORY_BYTES, Ending

MOST_CHARACTERS = 500
"""Of a refusal's line."""

INVALID = 1
"""Exit code of a refusal that may come when some is written: data on disk that do not agree with themselves."""

GOOD = ("accepted", "refused")
"""Verdicts that operators are promised; all others are failures."""

FAILURES = {
    "traceback": "a Python traceback on standard error",
    "internal": "exit code 70: an error that nobody foresaw",
    "signal": "killed by a signal of its own",
    "memory": f"asked for more than {MEMORY_BYTES / 1e9:.1f} GB",
    "time": f"took more than {CPU_S} s of processor time, or did not end",
    "code": "an exit code that its documentation does not have for this",
    "sentence": f"a refusal that is not one line of at most {MOST_CHARACTERS} characters naming the file or option",
    "noise": "warnings of libraries on standard error",
    "leftovers": "refused, and yet something was written, or something half-made stayed",
    "touched": "its input changed",
    "running": "processes stayed behind",
}

_NOISE = re.compile(r"Warning:|^Traceback|Exception ignored|^\w+Error:|\[[WE]:onnxruntime")
_PICTURE_LIBRARIES = re.compile(
    r"^libpng (error|warning)|^\[ ?(WARN|ERROR):\d+@|^(Corrupt JPEG|TIFF\w+:|Premature end)|^\[\w+ @ 0x"
)
"""What libpng, OpenCV and FFmpeg say themselves, of one picture among many that is damaged; no promise speaks of it."""

_FRAME = re.compile(r'File "[^"]*?((?:facegen|regress|tests)/[^"]+)", line (\d+), in (\S+)')


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What became of a case.

    Parameters
    ----------
    kind
        One of `GOOD` or of `FAILURES`.
    detail
        What was seen, in one line; of failures of one cause it is the same.
    """

    kind: str
    detail: str = ""

    @property
    def good(self) -> bool:
        """Whether the promise was kept."""
        return self.kind in GOOD


def judge(
    ending: Ending,
    *,
    program: str,
    stderr: str,
    accepts: tuple[int, ...],
    refuses: tuple[int, ...],
    names: tuple[str, ...],
    written: tuple[str, ...],
    half_made: tuple[str, ...],
    touched: tuple[str, ...],
    report: str,
) -> Verdict:
    """Judge one case.

    Parameters
    ----------
    ending
        How the process ended.
    program
        Its name, with which a refusal begins.
    stderr
        What it said.
    accepts
        Exit codes of success.
    refuses
        Exit codes of a refusal.
    names
        Words of which a refusal must have one: the damaged file, options.
    written, half_made
        What lies where output was to go: all of it, and what no command leaves on purpose.
    touched
        What changed in the input.
    report
        Content of the file that an internal error names.
    """
    lines = [line for line in stderr.splitlines() if line.strip() and not _PICTURE_LIBRARIES.search(line)]
    spoken = stderr + report
    if ending.overdue or ending.code == -signal.SIGXCPU:
        return Verdict(kind="time", detail=_place(spoken))
    if "MemoryError" in spoken or "bad_alloc" in spoken or "cannot allocate memory" in spoken.lower():
        return Verdict(kind="memory", detail=_place(spoken))
    if ending.code < 0:
        return Verdict(kind="signal", detail=f"signal {-ending.code}")
    if ending.code == 70:
        return Verdict(kind="internal", detail=_place(report) or (lines or [""])[-1][:200])
    if "Traceback (most recent call last)" in stderr:
        return Verdict(kind="traceback", detail=_place(stderr))
    if ending.left_running:
        return Verdict(kind="running")
    if touched:
        return Verdict(kind="touched", detail=", ".join(touched)[:200])
    if half_made:
        return Verdict(kind="leftovers", detail=", ".join(half_made)[:200])
    noise = [line for line in lines if _NOISE.search(line)]
    if noise:
        return Verdict(kind="noise", detail=re.sub(r"\d+", "N", noise[0])[:200])
    if ending.code in accepts:
        long = [line for line in lines if len(line) > 2 * MOST_CHARACTERS]
        return Verdict(kind="sentence", detail=long[0][:200]) if long else Verdict(kind="accepted")
    if ending.code not in refuses:
        return Verdict(kind="code", detail=f"{ending.code}: {(lines or [''])[-1][:160]}")
    written = () if ending.code == INVALID else written
    return _of_refusal(lines, program=program, names=names, written=written)


def _of_refusal(
    lines: list[str], *, program: str, names: tuple[str, ...], written: tuple[str, ...]
) -> Verdict:
    said = [line for line in lines if line.startswith(f"{program}: ")]
    if len(said) != 1 or lines[-1] != said[0]:
        return Verdict(kind="sentence", detail=f"{len(lines)} lines, last: {(lines or [''])[-1][:160]}")
    if len(said[0]) > MOST_CHARACTERS:
        return Verdict(kind="sentence", detail=f"{len(said[0])} characters: {said[0][:160]}")
    if not said[0].isprintable():
        return Verdict(kind="sentence", detail=f"unprintable: {said[0]!r}"[:200])
    if not any(name in said[0] for name in names):
        return Verdict(kind="sentence", detail=f"names neither file nor option: {said[0][:160]}")
    if written:
        return Verdict(kind="leftovers", detail=", ".join(written)[:200])
    return Verdict(kind="refused")


def _place(text: str) -> str:
    """Where a traceback ends in our own code, and the error's name: the same for failures of one cause."""
    frames = [frame for frame in _FRAME.findall(text) if not frame[0].startswith("tests/hostile")]
    errors = re.findall(
        r"^([\w.]*(?:Error|Exception|Interrupt|Warning|Exit|Fault)\b[^\n]{0,80})", text, re.MULTILINE
    )
    where = "{}:{} {}".format(*frames[-1]) if frames else ""
    return f"{where} {errors[-1] if errors else ''}".strip()
