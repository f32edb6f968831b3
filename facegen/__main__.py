"""Runs the ``facegen`` command as ``python -m facegen``."""

from facegen.cli import main

if __name__ == "__main__":
    main()
