"""Runs the command line, also as ``python -m track``."""

import os

from facegen.program import end_on_stops

MEDIA_FOUNDATION = "OPENCV_VIDEOIO_MSMF_ENABLE_HW_TRANSFORMS"
"""Whether Windows' Media Foundation converts pictures by the graphics card: some cameras then open after a minute."""


def main() -> None:
    """Entry point of the console script: stops are answered before the libraries load."""
    end_on_stops("track")
    os.environ.setdefault(MEDIA_FOUNDATION, "0")  # OpenCV reads it as it loads
    from track.cli import main as run_commands

    run_commands()


if __name__ == "__main__":
    main()
