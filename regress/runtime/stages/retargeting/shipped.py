"""The targets that come with the package, a TOML file each."""

from importlib import resources

TARGETS = resources.files("regress.runtime.stages.retargeting") / "targets"


def shipped_targets() -> tuple[str, ...]:
    """Names that `read_retargeting` knows without a file."""
    return tuple(sorted(path.name.removesuffix(".toml") for path in TARGETS.iterdir()))
