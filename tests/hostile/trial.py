"""Tries one case: honest input, damaged by one mutator with one seed, given to the command, and judged."""

import os
import shutil
import stat
from dataclasses import dataclass
from pathlib import Path
from random import Random

from facegen.console import one_line
from tests.hostile.mutators import FAMILIES, places
from tests.hostile.mutators.values import value_of
from tests.hostile.readers.reader import Reader
from tests.hostile.running import Order, Server
from tests.hostile.verdict import Verdict, judge
from tests.hostile.workshop import Workshop

HONEST = "honest"
"""Mutator that leaves the input as it is."""

_HALF_MADE = (".part", ".tmp", ".partial")


@dataclass(frozen=True, kw_only=True)
class Case:
    """A case can be run again from these three."""

    reader: Reader
    mutator: str
    seed: int

    def __str__(self) -> str:
        return f"{self.reader.name} {self.mutator} {self.seed}"

    @property
    def command(self) -> str:
        """What runs this case alone."""
        return f"python -m tests.hostile {self}"


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """A case that was tried."""

    case: Case
    verdict: Verdict
    words: tuple[str, ...]
    stderr: str
    cpu_s: float
    damaged: bytes | None


def mutators_of(reader: Reader) -> tuple[str, ...]:
    """Names of all that can be done to a reader's input."""
    if not reader.kind:
        return ("value",)
    return (*FAMILIES[reader.kind], "kind", "name")


def try_case(
    case: Case,
    server: Server,
    workshop: Workshop,
    folder: Path,
    *,
    replay: bytes | None = None,
    broken: str | None = None,
    limits: dict | None = None,
) -> Outcome:
    """Try one case in a folder that must not exist.

    Parameters
    ----------
    replay
        Content of the damaged file; without, the mutator makes it.
    broken
        Function that breaks a check in the command's process on purpose.
    limits
        Other limits than the usual.
    """
    reader, random = case.reader, Random(f"{case}")
    inside, outside, spare = folder / "in", folder / "out", folder / "spare"
    for path in (inside, outside, spare):
        path.mkdir(parents=True)
    reader.make(inside, workshop)
    value = value_of(reader.values, random) if case.mutator == "value" else ""
    words = reader.words(folder, workshop, value)
    target = _target(inside, reader, random) if reader.kind else None
    if target is not None and (case.mutator != HONEST or replay is not None):
        target, words = _damage(case, target, words, random, replay)
    if reader.reseal is not None and case.mutator not in ("kind", "name"):
        reader.reseal(target)
    before = _listing(inside)
    ending = server.run(
        Order(
            program=words[0],
            words=tuple(words[1:]),
            folder=str(folder),
            stdin=str(folder / reader.stdin)
            if reader.stdin and (folder / reader.stdin).is_file()
            else os.devnull,
            stdout=str(folder / "stdout"),
            stderr=str(folder / "stderr"),
            environment={"TMPDIR": str(spare), "HOME": str(spare), **reader.environment},
            broken=broken,
            **{"memory_bytes": reader.memory_bytes, **(limits or {})},
        )
    )
    after, written, left = _listing(inside), _listing(outside), _listing(spare)
    stderr = (folder / "stderr").read_bytes().decode("utf-8", "replace")
    verdict = judge(
        ending,
        program=words[0],
        stderr=stderr,
        accepts=reader.accepts,
        refuses=reader.refuses,
        names=(*_names(reader, target, words), *_names_of_value(value, case)),
        written=tuple(written),
        half_made=tuple(name for name in written if _is_half_made(name)),
        touched=() if reader.changes else _changed(before, after),
        report=_report(stderr, spare, left),
    )
    return Outcome(
        case=case,
        verdict=verdict,
        words=tuple(words),
        stderr=stderr,
        cpu_s=ending.cpu_s,
        damaged=target.read_bytes()
        if target is not None and target.is_file() and target.stat().st_size < 10**8
        else None,
    )


def _target(inside: Path, reader: Reader, random: Random) -> Path:
    found = sorted(inside.glob(reader.target))
    if not found:
        raise FileNotFoundError(f"{reader.name}: its honest input has no {reader.target}")
    return random.choice(found)


def _damage(
    case: Case, target: Path, words: list[str], random: Random, replay: bytes | None
) -> tuple[Path, list[str]]:
    """Damage the target; gives its path and the words, which may name it anew."""
    if replay is not None:
        target.unlink()
        target.write_bytes(replay)
        return target, words
    if case.mutator == "kind":
        places.kind(target, random)
        return target, words
    if case.mutator == "name":
        old = target.name
        target = places.name(target, random)
        return target, [word.replace(f"/{old}", f"/{target.name}") for word in words]
    damaged = FAMILIES[case.reader.kind][case.mutator](target.read_bytes(), random)
    target.unlink()  # it may be a link to what others need
    target.write_bytes(damaged)
    return target, words


def _names(reader: Reader, target: Path | None, words: list[str]) -> tuple[str, ...]:
    """Words of which a refusal has to have one."""
    options = [word.partition("=")[0] for word in words if word.startswith("--")]
    options += [one_line(word)[:60] for word in words if word.startswith("in/")]
    options += [value for value in reader.environment.values() if value.startswith("in/")]
    files = [] if target is None else [one_line(target.name)[:60]]
    return (*reader.names, *options, *files, *(["line ", "standard input"] if reader.stdin else []))


def _names_of_value(value: str, case: Case) -> tuple[str, ...]:
    """Forms in which a refusal may have a value; of one of a sign or less, any will do."""
    if case.mutator != "value":
        return ()
    option = value[:2] if value.startswith("-") else value
    return (one_line(value)[:40], repr(value)[1:40], option[:40]) if len(value.strip(".- ")) else ("",)


def _listing(folder: Path) -> dict[str, tuple]:
    """Kind, size and time of change of all below a folder."""
    found = {}
    for path in sorted(folder.rglob("*")):
        state = path.lstat()
        stamp = (state.st_size, state.st_mtime_ns) if stat.S_ISREG(state.st_mode) else ()
        found[path.relative_to(folder).as_posix()] = (state.st_mode, state.st_ino, *stamp)
    return found


def _changed(before: dict[str, tuple], after: dict[str, tuple]) -> tuple[str, ...]:
    return tuple(name for name in {**before, **after} if before.get(name) != after.get(name))


def _is_half_made(name: str) -> bool:
    last = name.rsplit("/", 1)[-1]
    return last.startswith(".") or last.endswith(_HALF_MADE)


def _report(stderr: str, spare: Path, left: dict[str, tuple]) -> str:
    """What an internal error wrote down."""
    for name in left:
        path = spare / name
        if path.is_file() and path.stat().st_size < 1_000_000:
            text = path.read_bytes().decode("utf-8", "replace")
            if "Traceback" in text:
                return text
    return ""


def clear(folder: Path) -> None:
    """Remove a case's folder, unreadable files and all."""
    shutil.rmtree(folder, ignore_errors=True)
