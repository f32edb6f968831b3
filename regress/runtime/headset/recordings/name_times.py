"""Reads times from the names of a camera's pictures: dates with a time of day, and clocks beside a counter."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from decimal import Decimal
from itertools import pairwise

_DATE = r"(?<!\d)(\d{4})[-_.]?(\d\d)[-_.]?(\d\d)[T_ .-]?(\d\d)[-_.:h]?(\d\d)[-_.:m]?(\d\d)"
_EPOCH = r"(?<!\d)(1\d{9})"
"""Seconds since 1970, until 2033."""

_POINT, _PARTED, _WHOLE = r"[.,](\d{1,9})(?!\d)", r"[_-]?(\d{3}|\d{6}|\d{9})(?!\d)", r"()(?!\d)"
"""What may stand behind whole seconds: a fraction behind a point, milliseconds to nanoseconds, or none."""

_FORMS = tuple(
    (re.compile(clock + behind), behind) for clock in (_DATE, _EPOCH) for behind in (_POINT, _PARTED, _WHOLE)
)

_SECONDS = re.compile(r"(\D*)(\d+)\.(\d+)")

_CLOSEST, _FARTHEST = Decimal("0.001"), 1
"""Seconds from one frame to the next: what is called by less or more is counted, not timed."""


@dataclass(frozen=True, kw_only=True)
class NameTimes:
    """What the clock in names says.

    Parameters
    ----------
    seconds
        Of each name, since 1970.
    rests
        Each name without its clock.
    """

    seconds: tuple[Decimal, ...]
    rests: tuple[str, ...]


def name_times(stems: Sequence[str]) -> NameTimes | None:
    """Times that all names have in one form, and of which not all lie in one second; None where there are none.

    Dates count as those of Greenwich: names seldom tell the zone, and only differences matter.
    """
    for form, behind in _FORMS:
        matches = [form.search(stem) for stem in stems]
        whole = [None if match is None else _since_1970(match.groups()[:-1]) for match in matches]
        if None in whole or len(set(whole)) < 2 or (behind == _WHOLE and _at_midnight(matches)):
            continue
        digits = [match.groups()[-1] for match in matches]
        if behind == _PARTED and (len(set(map(len, digits))) > 1 or _counts(whole, digits)):
            continue
        return NameTimes(
            seconds=tuple(at + Decimal(f"0.{part}0") for at, part in zip(whole, digits, strict=True)),
            rests=tuple(
                f"{stem[: match.start()]}#{stem[match.end() :]}"
                for stem, match in zip(stems, matches, strict=True)
            ),
        )
    return None


def decimal_seconds(stems: Sequence[str]) -> list[Decimal] | None:
    """Seconds with a fraction behind what all names begin with, as 12.345; None where names have another form."""
    found = [_SECONDS.fullmatch(stem) for stem in stems]
    if not all(found) or len({match[1] for match in found}) > 1:
        return None
    return [Decimal(f"{match[2]}.{match[3]}") for match in found]


def may_be_times(seconds: Sequence[Decimal]) -> bool:
    """Whether numbers with a fraction are as far apart as frames are, and not pictures 1.001 and 1.002 of a session."""
    ordered = sorted(seconds)
    steps = sorted(after - one for one, after in pairwise(ordered))
    last_digit = Decimal(1).scaleb(min(one.as_tuple().exponent for one in seconds))
    return bool(steps) and max(_CLOSEST, last_digit) < steps[len(steps) // 2] <= _FARTHEST


def _since_1970(parts: Sequence[str]) -> Decimal | None:
    """Whole seconds of an epoch's digits, or of a date and a time of day; None where there is no such day or time."""
    if len(parts) == 1:
        return Decimal(parts[0])
    try:
        found = datetime(*map(int, parts), tzinfo=timezone.utc)
    except ValueError:
        return None
    return Decimal(int(found.timestamp())) if found.year >= 1970 else None


def _at_midnight(matches: Sequence[re.Match[str]]) -> bool:
    """Whether all hours are 0, as of a counter of six digits behind a date."""
    return all(len(match.groups()) > 2 and match[4] == "00" for match in matches)


def _counts(whole: Sequence[Decimal | None], digits: Sequence[str]) -> bool:
    """Whether what stands behind whole seconds goes on by one within them, as a counter does."""
    ordered = sorted(zip(whole, map(int, digits), strict=True))
    steps = [after[1] - one[1] for one, after in pairwise(ordered) if one[0] == after[0]]
    return bool(steps) and sorted(steps)[len(steps) // 2] == 1
