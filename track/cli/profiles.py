"""``track profiles``: which there are, what is in them, and away with them."""

from typing import Annotated

import typer

profiles = typer.Typer(help="What is known of people before cameras.", no_args_is_help=True)

NameArgument = Annotated[str, typer.Argument(help="Of the profile or the person, or a .toml file.")]


@profiles.command("list")
def list_profiles() -> None:
    """List the stored profiles.

    Example: track profiles list
    """
    from facegen.console import one_line
    from track.profile.places import profile_folder, stored_profiles

    found = stored_profiles()
    for name, profile in found.items():
        if profile is None:
            typer.echo(one_line(f"{name}  cannot be read; `track profiles delete {name}` removes it"))
            continue
        known = ["neutral face"] if profile.neutral is not None else []
        known += [f"{len(profile.ranges)} ranges"] if profile.ranges else []
        known += ["blinks"] if profile.blinks else []
        known += [f"{len(profile.gains)} gains"] if profile.gains else []
        typer.echo(f"{name}  {one_line(profile.camera)}  {', '.join(known) or 'empty'}")
    if not found:
        typer.echo(f"no profile in {profile_folder()}; track calibrate makes one", err=True)


@profiles.command()
def show(name: NameArgument) -> None:
    """Print a profile: ranges, blinks, gains, and what its neutral face is of.

    Example: track profiles show me
    """
    from facegen.console import one_line
    from track.profile.places import read_stored, stored_path

    path = stored_path(name)
    profile = read_stored(path)
    who = one_line(f"{profile.person}, {profile.camera}")
    typer.echo(f"{path}: {who}{', mirrored' if profile.mirror else ''}")
    if profile.model is not None:
        typer.echo(f"model: {profile.model.kind} {profile.model.sha256[:12]}")
    if profile.neutral is not None:
        frames, pictures = len(profile.neutral.points or ()), len(profile.neutral.pictures)
        what = (
            f"{frames} frames of {profile.neutral.detector}" if frames else f"pictures of {pictures} cameras"
        )
        typer.echo(one_line(f"neutral face: {what}"))
    if profile.told_cameras:
        typer.echo(one_line(f"places known of: {', '.join(profile.told_cameras)}"))
    for shape, reading in profile.ranges.items():
        typer.echo(f"range  {shape:<20} {reading:.2f}")
    for shape, ends in profile.blinks.items():
        typer.echo(f"blink  {shape:<20} {ends.full:.2f} (open {ends.open:.2f})")
    for shape, gain in profile.gains.items():
        typer.echo(f"gain   {shape:<20} {gain:.2f}")


@profiles.command()
def delete(name: NameArgument) -> None:
    """Delete a profile; a file that is none stays.

    Example: track profiles delete me.camera-0
    """
    from track.profile.places import disposable_path

    path = disposable_path(name)
    path.unlink()
    typer.echo(f"deleted {path}", err=True)
