"""Draws docs/pictures/room-many.png: the programs that carry rooms for many, and what goes between them.

python docs/figures/room_many.py
"""

from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

OUT = Path(__file__).resolve().parents[1] / "pictures" / "room-many.png"
PEOPLE, SERVER, ENGINE = "#e3f3df", "#dceaf7", "#f5f1e3"
STATE, VOICE, COMMAND = "#1f6f9f", "#b3541e", "#777777"

BOXES = (
    (0.0, 0.0, 2.5, 4.1, "browsers", "of everybody", PEOPLE),
    (4.3, 2.75, 1.9, 1.35, "HAProxy", "one address", ENGINE),
    (7.6, 3.75, 2.7, 0.95, "room serve", "people of the 1st server", SERVER),
    (7.6, 2.15, 2.7, 0.95, "room serve", "people of the 2nd server", SERVER),
    (11.6, 2.7, 1.9, 1.35, "Redis", "keeps nothing", ENGINE),
    (7.6, 0.0, 2.7, 1.1, "Janus, one or more", "rooms are hashed over them", ENGINE),
    (4.3, 1.15, 1.9, 0.95, "coturn", "where needed", ENGINE),
)
ARROWS = (
    ((2.6, 3.45), (4.2, 3.45), "https: state,\nchat, signals", STATE, 3.85),
    ((6.3, 3.6), (7.5, 4.2), "", STATE, 0.0),
    ((6.3, 3.2), (7.5, 2.65), "", STATE, 0.0),
    ((10.4, 4.2), (11.5, 3.65), "", STATE, 0.0),
    ((10.4, 2.6), (11.5, 3.1), "", STATE, 0.0),
    ((8.95, 2.1), (8.95, 1.15), "", COMMAND, 0.0),
    ((2.6, 1.6), (4.2, 1.6), "", VOICE, 0.0),
    ((6.3, 1.4), (7.5, 0.8), "", VOICE, 0.0),
    ((2.6, 0.35), (7.5, 0.35), "", VOICE, 0.0),
)
NOTES = (
    (5.05, 0.62, "voices, encrypted: one line up, one down", VOICE),
    (12.5, 4.6, "who is there, states,\nchat, moderators' acts", STATE),
    (10.65, 1.6, "lines and rooms, of both servers,\nover a network of their own", COMMAND),
)


def main() -> None:
    """Draw the figure."""
    figure = Figure(figsize=(13.6, 5.3), dpi=100)
    FigureCanvasAgg(figure)
    axis = figure.add_axes((0.005, 0.01, 0.99, 0.98))
    for x, y, width, height, title, text, colour in BOXES:
        shape = FancyBboxPatch(
            (x, y), width, height, boxstyle="round,pad=0.04", facecolor=colour, edgecolor="#555555"
        )
        axis.add_patch(shape)
        middle = y + height / 2
        axis.text(x + width / 2, middle + 0.2, title, ha="center", va="center", fontsize=13, weight="bold")
        axis.text(x + width / 2, middle - 0.2, text, ha="center", va="center", fontsize=11)
    for start, end, text, colour, height in ARROWS:
        axis.annotate("", end, start, arrowprops={"arrowstyle": "<|-|>", "color": colour, "lw": 2.0})
        axis.text((start[0] + end[0]) / 2, height, text, ha="center", va="center", fontsize=11, color=colour)
    for x, y, text, colour in NOTES:
        axis.text(x, y, text, ha="center", va="center", fontsize=11, color=colour)
    axis.set_xlim(-0.15, 13.65)
    axis.set_ylim(-0.2, 5.1)
    axis.axis("off")
    figure.savefig(OUT)


if __name__ == "__main__":
    main()
