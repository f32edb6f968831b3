"""Draws docs/pictures/room-data.png: what of a meeting is sent to whom.

python docs/figures/room_data.py
"""

from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

OUT = Path(__file__).resolve().parents[1] / "pictures" / "room-data.png"
OWN, SERVER, OTHERS, PROGRAM = "#e3f3df", "#dceaf7", "#f5f1e3", "#efe6f5"
STATE, VOICE = "#1f6f9f", "#b3541e"

BOXES = (
    (0.0, 0.0, 3.5, 4.4, "your browser", OWN),
    (5.2, 2.0, 3.0, 2.4, "the room's server", SERVER),
    (9.9, 0.0, 3.5, 4.4, "the others' browsers", OTHERS),
    (4.8, 4.95, 3.8, 0.75, "track, on a machine of yours", PROGRAM),
)
TEXTS = (
    (1.75, 3.35, "camera's pictures: stay here\nand are kept nowhere"),
    (1.75, 2.2, "52 weights, gaze, head\n(MediaPipe and our networks)"),
    (1.75, 0.9, "microphone;\nspeaking or not is decided here"),
    (6.7, 3.35, "keeps who is in, and the\nlast state of each, in memory"),
    (6.7, 2.55, "writes no file"),
    (11.65, 3.35, "your avatar, where you stand,\nyour name, your sign"),
    (11.65, 2.2, "chat"),
    (11.65, 0.9, "your voice, from your head;\nthey see your network address"),
)
SPOKEN = "voice: straight from browser to browser, encrypted (by a TURN relay if you run one)"
ARROWS = (
    ((3.55, 3.2), (5.15, 3.2), "state, 85 bytes\n(113 with hands),\n30 a second;\nname, chat", STATE, 0.68),
    ((8.25, 3.2), (9.85, 3.2), "one buffer a tick:\n21 kbit/s a\nperson seen", STATE, 0.62),
    (
        (3.55, 0.8),
        (9.85, 0.8),
        SPOKEN,
        VOICE,
        0.25,
    ),
    ((6.7, 4.9), (6.7, 4.45), "", STATE, 0.0),
)


def main() -> None:
    """Draw the figure."""
    figure = Figure(figsize=(13.4, 5.8), dpi=100)
    FigureCanvasAgg(figure)
    axis = figure.add_axes((0.005, 0.01, 0.99, 0.98))
    for x, y, width, height, title, colour in BOXES:
        shape = FancyBboxPatch(
            (x, y), width, height, boxstyle="round,pad=0.04", facecolor=colour, edgecolor="#555555"
        )
        axis.add_patch(shape)
        axis.text(
            x + width / 2, y + height - 0.3, title, ha="center", va="center", fontsize=13, weight="bold"
        )
    axis.text(
        6.7, 5.15, "a face by other cameras: states, nothing else", ha="center", va="center", fontsize=10
    )
    for x, y, text in TEXTS:
        axis.text(x, y, text, ha="center", va="center", fontsize=11)
    for start, end, text, colour, above in ARROWS:
        axis.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 2.2})
        middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2 + above)
        axis.text(*middle, text, ha="center", va="center", fontsize=10, color=colour)
    axis.set_xlim(-0.15, 13.55)
    axis.set_ylim(-0.15, 5.85)
    axis.axis("off")
    figure.savefig(OUT)


if __name__ == "__main__":
    main()
