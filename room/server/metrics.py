"""Counts what a server does, as the text that Prometheus reads; totals only, no room's or person's name among them.

Format: https://prometheus.io/docs/instrumenting/exposition_formats/ (text, 0.0.4).
"""

import time
from dataclasses import dataclass

_MEANING = {
    "rooms": "Rooms with people in them.",
    "people": "People who have a place, broken connections among them.",
    "connections": "Open WebSockets.",
    "redis": "Whether Redis can be reached, of a server with --redis.",
    "engines": "Instances of Janus that answer.",
    "avatar_bytes": "Bytes of avatars that people brought.",
    "states": "States that came in.",
    "ticks_sent": "Ticks that went to somebody.",
    "ticks_dropped": "Ticks that a slow connection never got.",
    "bytes_sent": "Bytes of those ticks.",
    "texts": "Texts that came in.",
    "refused": "Connections that were refused or ended by a rule.",
    "slow": "Connections that were ended because they read too slowly.",
    "late_s": "Seconds by which ticks were late, all together.",
}
_NOW = ("rooms", "people", "connections", "redis", "engines", "avatar_bytes")


@dataclass(kw_only=True)
class Metrics:
    """Counts since the start; the first six are of now."""

    rooms: int = 0
    people: int = 0
    connections: int = 0
    redis: int = 0
    engines: int = 0
    avatar_bytes: int = 0
    states: int = 0
    ticks_sent: int = 0
    ticks_dropped: int = 0
    bytes_sent: int = 0
    texts: int = 0
    refused: int = 0
    slow: int = 0
    late_s: float = 0.0

    def text(self) -> str:
        """All of it, with the processor time of this process."""
        lines = []
        for field, meaning in _MEANING.items():
            now = field in _NOW
            ending = "" if now else "_total"
            name = f"room_{field.replace('late_s', 'late_seconds')}{ending}"
            kind = "gauge" if now else "counter"
            lines += (f"# HELP {name} {meaning}", f"# TYPE {name} {kind}", f"{name} {getattr(self, field)}")
        name = "process_cpu_seconds_total"
        lines += (f"# HELP {name} Processor time.", f"# TYPE {name} counter", f"{name} {time.process_time()}")
        return "\n".join(lines) + "\n"
