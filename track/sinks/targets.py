"""Names every sink there is, and reads what a person wrote behind ``--to``.

::

    NAME[:HOST[:PORT]][,OPTION=VALUE...]      vmc    vmc:192.168.1.5:39539    livelink:[::1]:11111,angles=half-turns
    NAME:FILE[,OPTION=VALUE...]               csv:take.csv    gltf:take.glb,avatar=head.glb
    NAME:LINK[,OPTION=VALUE...]               room:https://HOST:PORT/room/NAME#KEY.SECRET,cert=cert.pem

Without a host datagrams stay on this machine; another one gets them because it was named, and for no other reason.
"""

import importlib
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from facegen.redaction import without_secrets
from track.errors import InputError
from track.sinks.sink import Sink, Tell

THIS_MACHINE = "127.0.0.1"


@dataclass(frozen=True, kw_only=True)
class SinkKind:
    """One entry of the table of sinks.

    Parameters
    ----------
    description
        For people.
    module
        Of `track.sinks`, imported when the sink is opened: it has ``open_sink(target, tell)``.
    port
        Where its receivers listen by default; None for what is written to a file or has a link.
    options
        By name the values that are allowed; none of them means any text.
    needs
        What must stand behind the name where there is no port: ``FILE`` or ``LINK``.
    """

    description: str
    module: str
    port: int | None = None
    options: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    needs: str = "FILE"


SINKS: dict[str, SinkKind] = {
    "vmc": SinkKind(
        description="VSeeFace, Warudo, VMagicMirror, VNyan and others: expressions, head and eyes",
        module="vmc",
        port=39539,
        options={
            "names": ("both", "perfect-sync", "vrm0", "vrm1"),
            "emotions": ("off", "on"),
            "neck": ("on", "off"),
        },
    ),
    "livelink": SinkKind(
        description="Unreal, as the Live Link Face app",
        module="live_link",
        port=11111,
        options={"subject": (), "angles": ("radians", "half-turns")},
    ),
    "ifacialmocap": SinkKind(
        description="what listens to the iFacialMocap app, VRCFaceTracking among it",
        module="ifacialmocap",
        port=49983,
        options={"version": ("1", "2"), "sides": ("own", "mirrored")},
    ),
    "vrchat": SinkKind(
        description="VRChat itself: Unified Expressions as an avatar's parameters, and the eyes",
        module="vrchat",
        port=9000,
        options={
            "prefix": (),
            "bits": tuple(map(str, range(9))),
            "eyes": ("both", "parameters", "native"),
        },
    ),
    "room": SinkKind(
        description="a person's face in a room, by the link that the room's page shows to that person",
        module="room",
        options={"cert": ()},
        needs="LINK",
    ),
    "csv": SinkKind(
        description="the table of `regress predict`; names: of a retargeting, or its file",
        module="tables",
        options={"names": ()},
    ),
    "livelink-csv": SinkKind(description="a recording as the Live Link Face app keeps it", module="tables"),
    "gltf": SinkKind(
        description="an avatar (.glb, .vrm) that moves; names: of a retargeting, or its file",
        module="animations",
        options={"avatar": (), "names": ()},
    ),
    "vrma": SinkKind(
        description="an animation for any VRM avatar",
        module="animations",
        options={"names": ("both", "vrm1", "perfect-sync")},
    ),
}


@dataclass(frozen=True, kw_only=True)
class Target:
    """One ``--to``, understood.

    Parameters
    ----------
    name
        Key of `SINKS`.
    host, port
        Of a receiver; empty and None where there is none.
    place
        File or link, where there is one.
    options
        As they were given.
    """

    name: str
    host: str = ""
    port: int | None = None
    place: str = ""
    options: Mapping[str, str] = field(default_factory=dict)

    @property
    def title(self) -> str:
        """What a person calls it: ``"vmc to 127.0.0.1:39539"``; a link goes without its secret."""
        if self.port is None:
            return f"{self.name} to {self.place if self.is_file else without_secrets(self.place)}"
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{self.name} to {host}:{self.port}"

    @property
    def is_file(self) -> bool:
        """Whether a recording is written there."""
        return self.port is None and SINKS[self.name].needs == "FILE"

    @property
    def path(self) -> Path:
        """The file's."""
        return Path(self.place)


def parse_target(text: str) -> Target:
    """Understand one ``--to``.

    Raises
    ------
    InputError
        Where the sink is not known, or its address, file or an option cannot be used.
    """
    kind, name, place, options = _split(text)
    shown = without_secrets(text)
    for option, value in options.items():
        allowed = kind.options[option]
        if allowed and value not in allowed:
            raise InputError(f"--to {shown}: {option} is {value!r}; {' or '.join(allowed)} are allowed")
    if kind.port is not None:
        host, port = _address(place, kind.port, shown)
        return Target(name=name, host=host, port=port, options=options)
    if not place:
        raise InputError(f"--to {shown}: {name} needs a {kind.needs.lower()}; write {name}:{kind.needs}")
    return Target(name=name, place=place, options=options)


def open_sink(target: Target, tell: Tell) -> Sink:
    """Open a sink; ``tell`` takes sentences for the person, each once at most.

    Raises
    ------
    InputError, OutputError
        Where its host is not known, or its file cannot be written.
    """
    module = importlib.import_module(f"track.sinks.{SINKS[target.name].module}")
    return module.open_sink(target, tell)


def _split(text: str) -> tuple[SinkKind, str, str, dict[str, str]]:
    """The sink's kind and name, what stands behind the colon, and the options, which are the last commas' parts."""
    name, shown = re.split(r"[:,]", text, maxsplit=1)[0], without_secrets(text)
    kind = SINKS.get(name)
    if kind is None:
        raise InputError(
            f"--to {shown}: there is no sink {without_secrets(name)!r}; {', '.join(SINKS)} are known"
        )
    rest, options = text[len(name) :], {}
    while match := re.search(r",([a-z_]+)=([^,]*)$", rest):
        if match[1] not in kind.options:
            known = ", ".join(kind.options) or "none"
            raise InputError(f"--to {shown}: {name} has no option {match[1]!r}; {known} are known")
        rest, options[match[1]] = rest[: match.start()], match[2]
    if rest and not rest.startswith(":"):
        raise InputError(
            f"--to {shown}: {without_secrets(rest)!r} is no option; write {name}:PLACE,OPTION=VALUE"
        )
    return kind, name, rest[1:], options


def _address(place: str, port: int, shown: str) -> tuple[str, int]:
    match = re.fullmatch(r"(?:\[([0-9a-fA-F:.]+(?:%[\w.-]+)?)\]|([^\[\]:\s/]*))(?::(\d{1,9}))?", place)
    if match is None:
        raise InputError(
            f"--to {shown}: {without_secrets(place)!r} is no address; HOST, HOST:PORT or [IPV6]:PORT are allowed, "
            f"as in 127.0.0.1:{port}"
        )
    host, given = match[1] or match[2] or THIS_MACHINE, int(match[3] or port)
    if not 1 <= given <= 65535:
        raise InputError(f"--to {shown}: there is no port {given}; 1 to 65535 are allowed")
    return host, given
