"""The page's controls in a real browser: what is clicked arrives at the session, and what holds is shown."""

import asyncio
import contextlib

import aiohttp
import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from tests.browser import needs_chromium
from tests.track.page.stand import STEPS, moment_of, standing
from track.messages import Command, Step
from track.page import Page
from track.page.server import MOST_VIEWERS

pytestmark = [needs_chromium, pytest.mark.slow]


HIDDEN = """(hidden => {
    Object.defineProperty(document, 'hidden', { configurable: true, get: () => hidden });
    document.dispatchEvent(new Event('visibilitychange'));
})"""


async def watched(stand, wanted: bool) -> None:
    """Wait until the session has a tab to show anything to, or none."""
    for _ in range(1200):
        if stand.page.watched is wanted:
            return
        await asyncio.sleep(0.1)
    pytest.fail(f"the page's server is {'not ' if wanted else ''}looked at")


def test_a_page_that_nobody_sees_costs_the_session_nothing_and_goes_on_when_it_is_seen(loop, stand):
    async def hide():
        assert (await stand.asks(1))[0] == Command(verb="picture", value=True)
        await stand.publish_until("connection.dataset.state === 'live'")
        await stand.tab.ask("step.value = 'smile'")
        for _ in range(2):
            await stand.tab.ask(f"{HIDDEN}(true)")
            await watched(stand, False)
            assert await stand.asks(1) == [Command(verb="picture", value=False)]
            await stand.tab.ask(f"{HIDDEN}(false)")
            await watched(stand, True)
            assert await stand.asks(1) == [Command(verb="picture", value=True)]
            await stand.publish_until("connection.dataset.state === 'live'")
            await stand.publish_until("document.querySelector('#cameras canvas')")
        assert await stand.tab.ask("step.value") == "smile"
        await stand.tab.ask(f"{HIDDEN}(true), {HIDDEN}(false)")  # before the line is closed
        await asyncio.sleep(0.5)  # the page says "live" of the line before until that is closed
        await watched(stand, True)
        await stand.publish_until("connection.dataset.state === 'live'")
        assert stand.page.watched

    loop.run_until_complete(hide())


def test_a_hidden_page_that_records_is_told_of_every_frame_until_it_stops(loop, stand):
    async def record():
        await stand.publish_until("connection.dataset.state === 'live'", settings={"recording": True})
        await stand.publish_until("record.classList.contains('on')", settings={"recording": True})
        await stand.tab.ask(f"{HIDDEN}(true)")
        for _ in range(20):
            stand.page.publish(moment_of(np.zeros(52), settings={"recording": True}))
            await asyncio.sleep(0.05)
        assert stand.page.watched
        for _ in range(1200):
            stand.page.publish(moment_of(np.zeros(52), settings={"recording": False}))
            await asyncio.sleep(0.1)
            if not stand.page.watched:
                break
        assert not stand.page.watched

    loop.run_until_complete(record())


def test_what_is_clicked_is_asked_for_and_what_holds_is_shown(loop, stand):
    async def click():
        assert (await stand.asks(1))[0] == Command(verb="picture", value=True)
        await stand.publish_until("document.querySelector('#cameras canvas')")
        drawn = """(() => {
            const canvas = document.querySelector('#cameras canvas'), { width, height } = canvas;
            const copy = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
            copy.drawImage(canvas, 0, 0);
            const image = copy.getImageData(0, 0, width, height);
            return [width, height, image.data.filter((value, at) => at % 4 === 1 && value > 168).length];
        })()"""  # green of the points, on grey
        width, height, green = await stand.tab.ask(drawn)
        assert (width, height) == (160, 120)
        assert green > 60
        await stand.tab.ask("points.click()")
        await stand.publish_until(f"{drawn}[2] === 0")
        await stand.tab.ask(
            "step.value = 'jaw_open', document.querySelector('#calibrate button').click(), mirror.click(),"
            "recentre.click(), picture.click(), gains.click(), 0"
        )
        await stand.tab.ask(
            "(() => { const slider = document.querySelector('[data-shape=jawOpen] input');"
            "slider.value = 1.5; slider.dispatchEvent(new Event('input')); })()"
        )
        expected = [
            Command(verb="calibrate", value="jaw_open"),
            Command(verb="mirror", value=True),
            Command(verb="recentre"),
            Command(verb="picture", value=False),
            Command(verb="gain", shape="jawOpen", value=1.5),
        ]
        assert await stand.asks(5) == expected
        assert not await stand.tab.ask("document.querySelector('#cameras canvas')")
        await stand.tab.ask("document.getElementById('gains-reset').click()")
        assert await stand.asks(1) == [Command(verb="gain", shape="jawOpen", value=1)]
        # another tab changes things: this one follows
        await stand.publish_until(
            "mirror.ariaPressed === 'false' && document.querySelector('[data-shape=tongueOut] input').value === '2'"
            "&& document.querySelector('[data-shape=tongueOut] .factor').textContent === '×2'",
            settings={"mirror": False, "gains": {"tongueOut": 2.0}},
        )
        await stand.publish_until(
            "person.textContent === 'not calibrated yet'", settings={"calibrated": False}
        )
        known = {"calibrated": True, "profile": "<i>Ada</i>"}
        await stand.publish_until("person.textContent === 'as <i>Ada</i>'", settings=known)
        await stand.tab.ask("record.click()")
        assert await stand.asks(1) == [Command(verb="record", value=True)]

    loop.run_until_complete(click())


def test_calibration_says_what_to_do_and_can_be_cancelled(loop, stand):
    step = Step(name="jaw_open", state="recording", seconds_left=1.4, text="Open <b>wide</b>")

    async def look():
        asking = "document.getElementById('asking')"
        before = Step(name="smile", state="done", seconds_left=0.0, text="All done")
        await stand.show(np.full(52, 0.25), step=before)
        assert await stand.tab.ask(f"{asking}.hidden"), "it was over before this page came"
        await stand.publish_until(f"!{asking}.hidden", step=step)
        assert await stand.tab.ask(f"{asking}.innerText.split('\\n').filter(Boolean)") == [
            "2",
            "Jaw open · Hold it",
            "Open <b>wide</b>",
            "Cancel",
        ]
        await stand.tab.ask("document.getElementById('asking-cancel').click()")
        assert await stand.asks(2) == [Command(verb="picture", value=True), Command(verb="cancel")]
        await stand.publish_until(f"{asking}.hidden")
        # the last step is told with every frame, and shown for four seconds
        over = Step(name="jaw_open", state="done", seconds_left=0.0, text="Done")
        await stand.publish_until(f"{asking}.innerText.includes('Done')", step=over)
        await stand.publish_until(f"{asking}.hidden", step=over)
        await stand.tab.ask(
            f"(globalThis.again = 0, new MutationObserver(() => again++).observe({asking}, {{ attributes: true }}))"
        )
        for _ in range(20):
            stand.page.publish(moment_of(np.zeros(52), step=over))
            await asyncio.sleep(0.05)
        assert await stand.tab.ask("again") == 0

    loop.run_until_complete(look())


@pytest.mark.parametrize("way", ["asking-cancel.click()", "dispatchEvent(escape)"])
def test_calibration_can_be_ended_between_two_faces(loop, stand, way):
    asked = Step(name="jaw_open", state="recording", seconds_left=1.0, text="Open")
    good = Step(name="jaw_open", state="done", seconds_left=0.7, text="Good")
    escape = "new KeyboardEvent('keydown', { key: 'Escape' })"
    script = way.replace("asking-cancel", "document.getElementById('asking-cancel')").replace(
        "escape", escape
    )

    async def look():
        assert (await stand.asks(1))[0] == Command(verb="picture", value=True)
        going_on = {"settings": {"calibrating": True}}
        await stand.publish_until(
            "document.getElementById('asking-text').textContent", step=asked, **going_on
        )
        await stand.publish_until(
            "document.getElementById('asking-text').textContent === 'Good'", step=good, **going_on
        )
        assert not await stand.tab.ask("document.getElementById('asking-cancel').hidden")
        await stand.tab.ask(f"void {script}")
        assert await stand.asks(1) == [Command(verb="cancel")]
        over = {"settings": {"calibrating": False}}
        await stand.publish_until("document.getElementById('asking-cancel').hidden", step=good, **over)

    loop.run_until_complete(look())


def test_what_came_of_what_was_asked_for_is_shown(loop, stand):
    said = "document.getElementById('said')"

    async def look():
        before = ((4, "said before this page came"),)
        await stand.publish_until("connection.dataset.state === 'live'", said=before)
        assert await stand.tab.ask(f"{said}.hidden")
        now = (*before, (5, "the head is centred"), (6, "recorded csv to <b>a.csv</b>"))
        shown = "The head is centred. Recorded csv to <b>a.csv</b>"
        await stand.publish_until(f"{said}.textContent === '{shown}'", said=now)
        assert not await stand.tab.ask(f"{said}.hidden")

    loop.run_until_complete(look())


def test_a_tab_too_many_is_told_what_to_do(loop, browser, egg):
    async def look():
        async with aiohttp.ClientSession() as session, contextlib.AsyncExitStack() as others:
            with Page([].append, steps=STEPS, avatar=egg) as page:
                for _ in range(MOST_VIEWERS):
                    await others.enter_async_context(session.ws_connect(f"{page.url}stream"))
                async with browser.open(page.url) as tab:
                    await tab.until(
                        f"globalThis.track && connection.textContent.startsWith('{MOST_VIEWERS} tabs look already')"
                    )

    loop.run_until_complete(look())


def test_faults_are_named_while_they_last(loop, stand):
    fault = "The camera <script>alert(1)</script> shows nobody."

    async def look():
        await stand.publish_until("faults.textContent", faults=(fault,))
        assert await stand.tab.ask("[...faults.children].map((each) => each.textContent)") == [fault]
        await stand.publish_until("faults.textContent === ''")

    loop.run_until_complete(look())


def test_a_take_is_played_back_while_live_goes_on(loop, stand):
    async def look():
        await stand.tab.ask("record.click()")
        spoken = np.zeros(52)
        spoken[BLENDSHAPES.index("jawOpen")] = 0.8
        await stand.show(spoken)
        await stand.tab.ask("record.click()")
        await stand.show(np.zeros(52))
        await stand.tab.ask("play.click()")
        await stand.publish_until("Math.abs(track.stage.avatar.influences().jawOpen - 0.8) < 0.001")
        await stand.tab.ask("play.click()")
        await stand.publish_until("track.stage.avatar.influences().jawOpen < 0.001")

    loop.run_until_complete(look())


def test_the_page_comes_back_by_itself(loop, browser, egg):
    async def look():
        async with standing(browser, egg, quiet=False) as stand:
            await stand.publish_until("connection.dataset.state === 'live'")
            await asyncio.to_thread(stand.page.close)
            await stand.tab.until("connection.dataset.state === 'lost'")
            assert (await stand.tab.ask("connection.textContent")).startswith("track has ended")
            asked = []
            with Page(asked.append, port=stand.page.port, steps=STEPS, avatar=egg) as again:
                stand.page = again
                await stand.publish_until("connection.dataset.state === 'live'")
                await stand.show(np.full(52, 0.5))
                await stand.tab.until("connection.textContent === 'Nothing comes from the camera'")

    loop.run_until_complete(look())


@pytest.mark.parametrize(("host", "said"), [("127.0.0.1", "never leave"), ("0.0.0.0", "without encryption")])
def test_the_page_says_where_pictures_go(loop, browser, egg, host, said):
    async def look():
        with Page([].append, host, steps=STEPS, avatar=egg) as page:
            async with browser.open(page.url) as tab:
                await tab.until("globalThis.track && connection.dataset.state === 'waiting'")
                await tab.until(f"document.getElementById('stays').textContent.includes('{said}')")

    loop.run_until_complete(look())


def test_a_tab_with_another_runs_link_says_which_to_open(loop, browser, egg):
    async def look():
        with Page([].append, steps=STEPS, avatar=egg, token="first" * 4) as page:
            async with browser.open(page.url) as tab:
                await tab.until("globalThis.track && connection.dataset.state === 'waiting'")
                await asyncio.to_thread(page.close)
                with Page([].append, port=page.port, steps=STEPS, avatar=egg, token="other" * 4):
                    await tab.until("connection.textContent.startsWith('track has another link')")

    loop.run_until_complete(look())
