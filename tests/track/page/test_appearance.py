"""How the page looks in a real browser: nothing is cut off, and everyone can use all of it."""

from pathlib import Path

import numpy as np
import pytest

from tests.browser import needs_chromium

AXE = Path(__file__).resolve().parents[3] / "web/node_modules/axe-core/axe.min.js"

pytestmark = [needs_chromium, pytest.mark.slow]


@pytest.mark.parametrize(("width", "dark"), [(320, True), (400, False), (1600, True)])
def test_nothing_is_cut_off_and_all_can_be_used_by_everyone(loop, stand, tmp_path, width, dark):
    async def look():
        await stand.tab.look(width=width, height=900, dark=dark, telephone=width < 600)
        await stand.show(np.linspace(0, 1, 52), faults=("The picture is dark: light from the front helps.",))
        await stand.tab.ask("gains.click()")
        assert await stand.tab.ask("document.documentElement.scrollWidth") <= width
        await stand.tab.picture(tmp_path / "page.png", whole=True)
        if AXE.exists():
            await stand.tab.ask(AXE.read_text() + ";0")
            return await stand.tab.ask(
                "axe.run().then(({ violations }) => violations.map((each) => each.id + ' ' + each.nodes[0].html))"
            )

    assert not loop.run_until_complete(look())
    assert (tmp_path / "page.png").stat().st_size > 20_000


def test_the_keyboard_reaches_everything_and_shows_where_it_is(loop, stand):
    async def walk():
        reached, bare = set(), []
        for _ in range(40):
            for kind in ("rawKeyDown", "keyUp"):
                await stand.tab.call(
                    "Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9
                )
            name, outlined = await stand.tab.ask(
                "(() => { const at = document.activeElement; const shown = at.id === 'file' "
                "? document.querySelector('label[for=file]') : at;"
                "return [at.id || at.className || at.tagName, getComputedStyle(shown).outlineStyle !== 'none']; })()"
            )
            reached.add(name)
            bare += [] if outlined or name in ("BODY", "controls") else [name]
        return reached, bare

    reached, bare = loop.run_until_complete(walk())
    wanted = {"step", "first", "mirror", "recentre", "picture", "points", "record", "file", "gains", "skip"}
    assert wanted <= reached
    assert bare == []
