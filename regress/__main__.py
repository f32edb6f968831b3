"""``python -m regress`` is the ``regress`` command."""

from regress.cli import main

if __name__ == "__main__":
    main()
