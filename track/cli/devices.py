"""``track devices``: which cameras there are."""


def devices() -> None:
    """List the cameras of this machine.

    Example: track devices
    """
    from track.sources.webcams import list_webcams

    for webcam in list_webcams():
        print(f"{webcam.number}  {webcam.name}")
