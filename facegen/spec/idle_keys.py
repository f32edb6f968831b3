"""Names the keys of a spec that do not count for its kind: they change its hash, and no sample."""

from operator import attrgetter

from facegen.spec.spec import Spec

IDLE = {
    "still": ("sequence", "playback"),
    "sequence": (
        *("still", "playback", "gaze.wide"),
        *("expression.mixture", "expression.subtle", "expression.blinks"),
    ),
    "playback": ("still", "sequence", "expression", "gaze"),
}
"""For each kind, tables and keys that nothing of it is drawn by."""


def idle_keys(spec: Spec) -> tuple[str, ...]:
    """Those of `IDLE` that are not as in a spec that leaves them out."""
    plain = Spec(version=spec.version, kind=spec.kind, seed=spec.seed, people=spec.people)
    return tuple(name for name in IDLE[spec.kind] if attrgetter(name)(spec) != attrgetter(name)(plain))


def idle_note(spec: Spec) -> str:
    """A sentence on `idle_keys`; nothing where there are none."""
    keys = idle_keys(spec)
    if not keys:
        return ""
    return (
        f'{", ".join(keys)}: no sample depends on it where kind = "{spec.kind}", and the hash does; leave it out of a '
        "new spec"
    )
