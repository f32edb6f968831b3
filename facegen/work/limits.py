"""Defines the limits of a run: when a worker is replaced, and when all is given up."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Limits:
    """When a worker is replaced, and when a run is given up.

    Attributes
    ----------
    silence_s
        A worker that for so long neither reports nor uses the processor hangs; it is killed, its task tried
        again.
    phase_s
        So long may one view or block take; an endless loop uses the processor, too.
    renew_after
        Tasks after which a process is renewed; a precaution, 300 renders left its size unchanged within 3 %.
    memory
        Bytes above which a process is renewed after its task; 0 for no limit, None for its share of what there is.
    failed_starts
        Starts that fail one after another before the run is given up.
    start_wait_s
        Pause after the first of them; it doubles each time.
    failed_tasks
        The run is given up when at least so many tasks failed for good, and more than were made.
    """

    silence_s: float = 300.0
    phase_s: float = 3600.0
    renew_after: int = 1000
    memory: int | None = None
    failed_starts: int = 5
    start_wait_s: float = 1.0
    failed_tasks: int = 10
