"""The options of a guided minute: a folder for each face, or frames of one take, its cameras and their places."""

from pathlib import Path
from typing import Annotated

import typer


def _face(asked: str) -> type:
    return Annotated[
        str | None,
        typer.Option(metavar="FOLDER|FIRST-LAST", help=f"{asked}: a folder, or frames of the take."),
    ]


Rest = _face("The face at rest, needed")
Shut = _face("Both eyes shut")
Wide = _face("Both eyes wide open")
JawOpen = _face("The mouth as wide as it goes")
LipsRolled = _face("Both lips rolled in")
Smile = _face("As broad a smile as can be")
Cheeks = _face("Both cheeks puffed")
BrowsUp = _face("Brows as high as they go")
Pucker = _face("Lips as for a kiss")
Look = _face("Looking around, or at --looked-at")

Take = Annotated[
    list[str] | None,
    typer.Option(
        "--camera", metavar="NAME=PATH", help="A camera's pictures or film of one take of all faces."
    ),
]
Placement = Annotated[Path | None, typer.Option("--placement", help="TOML of `regress headset check`.")]
