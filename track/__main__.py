"""Runs the command line, also as ``python -m track``."""

from facegen.program import end_on_stops


def main() -> None:
    """Entry point of the console script: stops are answered before the libraries load."""
    end_on_stops("track")
    from track.cli import main as run_commands

    run_commands()


if __name__ == "__main__":
    main()
