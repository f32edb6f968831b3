"""Small PDFs for tests of the shared screen: pages of one colour with a word on them, and files that mean harm."""

from collections.abc import Sequence

Colour = tuple[float, float, float]


def paper(*pages: tuple[int, int, Colour], trailer: str = "") -> bytes:
    """A PDF of pages (width, height, colour), each with a word in Helvetica, which the file does not bring along."""
    kids = " ".join(f"{4 + 2 * index} 0 R" for index in range(len(pages)))
    bodies = [
        "<< /Type /Catalog /Pages 2 0 R >>",
        f"<< /Type /Pages /Kids [{kids}] /Count {len(pages)} >>",
        "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>",
    ]
    for index, (width, height, colour) in enumerate(pages):
        bodies.append(
            f"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width} {height}] /Contents {5 + 2 * index} 0 R "
            "/Resources << /Font << /F 3 0 R >> >> >>"
        )
        red, green, blue = colour
        drawn = (
            f"{red} {green} {blue} rg 0 0 {width} {height} re f "
            f"0 g BT /F {height // 5} Tf {width // 20} {height // 20} Td (Page) Tj ET"
        )
        bodies.append(f"<< /Length {len(drawn)} >>\nstream\n{drawn}\nendstream")
    return _file(bodies, trailer)


def _file(bodies: Sequence[str], trailer: str) -> bytes:
    content, places = b"%PDF-1.4\n", []
    for number, body in enumerate(bodies, start=1):
        places.append(len(content))
        content += f"{number} 0 obj\n{body}\nendobj\n".encode()
    table = "".join(f"{place:010} 00000 n \n" for place in places)
    return (
        content
        + (
            f"xref\n0 {len(bodies) + 1}\n0000000000 65535 f \n{table}"
            f"trailer\n<< /Size {len(bodies) + 1} /Root 1 0 R {trailer} >>\nstartxref\n{len(content)}\n%%EOF\n"
        ).encode()
    )


LOCKED = paper(
    (200, 100, (1, 1, 1)),
    trailer=f"/Encrypt << /Filter /Standard /V 1 /R 2 /P -4 /O <{'41' * 32}> /U <{'42' * 32}> >> "
    f"/ID [<{'43' * 16}> <{'43' * 16}>]",
)
"""Opens by a password alone."""
