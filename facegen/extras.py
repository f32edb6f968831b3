"""Lists which module comes with which extra of the installation, and says how to get one that is absent."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Extra:
    """An extra of the distribution ``facegen``, as ``pip install 'facegen[NAME]'`` takes it.

    Attributes
    ----------
    name
        As in pyproject.toml.
    modules
        Top-level modules that the extra brings and the base installation lacks.
    python
        The only Python that the extra is built for, ``"3.11"``; None for every Python of the base.
    """

    name: str
    modules: frozenset[str]
    python: str | None = None


FACTORY = Extra(
    name="factory",
    modules=frozenset(
        (
            *("bpy", "mathutils", "_cycles"),  # the latter two come with bpy
            *("jinja2", "matplotlib", "numba", "OpenEXR", "PIL", "pyarrow", "scipy", "tomli_w"),
            "tomllib",  # of Python 3.11 itself: what reads specs is not for the base's Python 3.10
        )
    ),
    python="3.11",
)
LEARN = Extra(name="learn", modules=frozenset(("jinja2", "onnx", "pyarrow", "scipy", "sklearn")))
HEADSET = Extra(name="headset", modules=frozenset(("torch",)))
LIVE = Extra(name="live", modules=frozenset(("aiohttp", "mediapipe", "platformdirs", "pythonosc", "tomli_w")))
ROOM = Extra(name="room", modules=frozenset(("aiohttp",)))
REDIS = Extra(name="redis", modules=frozenset(("redis",)))


def missing_extra(error: ModuleNotFoundError, command: str, extras: tuple[Extra, ...]) -> str | None:
    """Say in one sentence how to get the extra whose module was not found.

    Parameters
    ----------
    error
        The failed import.
    command
        What was called, for example ``"facegen generate"``.
    extras
        Extras that the program has a use for; the first one with the module is named.

    Returns
    -------
    str or None
        The sentence; None where the module belongs to none of the extras, which is a fault of the program.
    """
    module = (error.name or "").partition(".")[0]
    for extra in extras:
        if module in extra.modules:
            python = f" in Python {extra.python}" if extra.python else ""
            return (
                f"{command} needs the {extra.name} extra, which is not installed (no module named {module!r}): "
                f"pip install 'facegen[{extra.name}]'{python}"
            )
    return None
