"""One person at a time shows something on the room's screens: by the rules, and in two tabs of a real browser."""

import asyncio
import base64
import functools
from collections.abc import Awaitable, Callable

import pytest

from room.protocol.answers import Changed, Notice, Signal
from tests.browser import Tab, chromium, needs_chromium
from tests.room.bare_place import BARE, WALL_Z_M
from tests.room.guests import Place, open_room
from tests.room.page import AWAKE, come_in
from tests.room.papers import LOCKED, paper


def meeting(test: Callable[[Place], Awaitable[None]]) -> Callable[[], None]:
    @functools.wraps(test)
    def run() -> None:
        async def held() -> None:
            async with open_room() as place:
                await test(place)

        asyncio.run(held())

    del run.__wrapped__  # pytest would ask for the place
    return run


def _shares(number: int, on: bool = True) -> Callable[[Changed], bool]:
    return lambda changed: changed.person.number == number and changed.person.shares is on


@meeting
async def test_one_shares_and_all_are_told_who(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    await ada.say(kind="share", on=True)
    await ben.told(Changed, _shares(ada.number))
    await ben.say(kind="share", on=True)
    assert "Ada shares already" in (await ben.told(Notice)).text
    late = await place.guest(name="Cy")
    assert [person.number for person in late.welcome.people if person.shares] == [ada.number]
    await ada.say(kind="share", on=False)
    await ben.told(Changed, _shares(ada.number, on=False))
    await ben.say(kind="share", on=True)
    await ada.told(Changed, _shares(ben.number))


@meeting
async def test_a_moderator_ends_it_and_a_mute_keeps_from_it(place):
    chair, ada = await place.guest(moderator=True, name="Chair"), await place.guest()
    await ada.say(kind="share", on=True)
    await chair.told(Changed, _shares(ada.number))
    await chair.say(kind="moderate", action="unshare", number=ada.number)
    await ada.told(Changed, _shares(ada.number, on=False))
    await chair.say(kind="moderate", action="mute", number=ada.number)
    await ada.say(kind="share", on=True)
    notice = await ada.told(Notice)
    assert "muted" in notice.text
    assert notice.about == "share", "so that the page lets go of what it has taken already"


@meeting
async def test_who_is_muted_shows_nothing_any_more(place):
    chair, ada = await place.guest(moderator=True, name="Chair"), await place.guest()
    await ada.say(kind="share", on=True)
    await chair.told(Changed, _shares(ada.number))
    await chair.say(kind="moderate", action="mute", number=ada.number)
    await ada.told(Changed, _shares(ada.number, on=False))


@meeting
async def test_a_page_that_is_loaded_anew_shares_no_longer(place):
    ada, ben = await place.guest(visit="first"), await place.guest(name="Ben")
    await ada.say(kind="share", on=True)
    await ben.told(Changed, _shares(ada.number))
    again = await place.guest(secret=ada.secret, visit="first")
    assert any(person.shares for person in again.welcome.people), "a connection that broke changes nothing"
    again = await place.guest(secret=ada.secret, visit="second")
    assert not any(person.shares for person in again.welcome.people)


@meeting
async def test_who_leaves_frees_the_screen(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    await ada.say(kind="share", on=True)
    await ben.told(Changed, _shares(ada.number))
    await ada.say(kind="leave")
    await ben.say(kind="share", on=True)
    await ben.told(Changed, _shares(ben.number))


@meeting
async def test_signals_of_the_screen_pass_only_to_and_from_who_shares(place):
    ada, ben, cy = await place.guest(), await place.guest(name="Ben"), await place.guest(name="Cy")
    offer = {"kind": "description", "plane": "screen", "type": "offer", "sdp": "v=0"}
    await ben.say(**offer, to=cy.number)
    await ada.say(kind="share", on=True)
    await ben.told(Changed, _shares(ada.number))
    await ada.say(**offer, to=cy.number)
    await ben.say(**offer | {"type": "answer"}, to=ada.number)
    heard = await cy.told(Signal)
    assert (heard.sender, heard.signal.plane) == (ada.number, "screen")
    assert (await ada.told(Signal)).sender == ben.number
    assert len(cy.all(Signal)) == 1, "Ben, who shares nothing, shows Cy nothing"


@meeting
async def test_who_shares_may_call_thirty_people_at_once(place):
    ada, ben = await place.guest(), await place.guest(name="Ben")
    await ada.say(kind="share", on=True)
    for sdp in range(12 * 30):  # an offer and its candidates for each, within a second
        await ada.say(kind="description", plane="screen", type="offer", sdp=f"v={sdp}", to=ben.number)
    await ben.told(Signal, lambda told: told.signal.sdp == f"v={12 * 30 - 1}")
    assert not ada.socket.closed


PICTURE = """(async () => {
  const canvas = new OffscreenCanvas(640, 360), pen = canvas.getContext('2d');
  pen.fillStyle = '#e02020'; pen.fillRect(0, 0, 640, 360);
  const file = new File([await canvas.convertToBlob({ type: 'image/png' })], 'red.png', { type: 'image/png' });
  const carried = new DataTransfer(); carried.items.add(file);
  const input = document.querySelector('#file');
  input.files = carried.files; input.dispatchEvent(new Event('change'));
})()"""
SEEN = """(() => {
  const pen = new OffscreenCanvas(8, 8).getContext('2d');
  pen.drawImage(meeting.screen.board.film, 0, 0, 8, 8);
  return [...pen.getImageData(4, 4, 1, 1).data];
})()"""
PAPER = """((encoded, name) => {
  const file = new File([Uint8Array.from(atob(encoded), (each) => each.charCodeAt(0))], name);
  const carried = new DataTransfer(); carried.items.add(file);
  const input = document.querySelector('#paper');
  input.files = carried.files; input.dispatchEvent(new Event('change'));
})"""
LARGE = """(() => {
  const carried = new DataTransfer(); carried.items.add(new File([new Uint8Array(2 ** 26 + 1)], 'large.pdf'));
  const input = document.querySelector('#paper');
  input.files = carried.files; input.dispatchEvent(new Event('change'));
})()"""
DARK = """(() => {
  const { film } = meeting.screen.board, pen = new OffscreenCanvas(160, 120).getContext('2d');
  pen.drawImage(film, 0, 0, 160, 120);
  const { data } = pen.getImageData(0, 60, 160, 60);
  return data.filter((value, at) => at % 4 === 2 && value < 60).length;
})()"""
"""How much of the lower half has no blue: of a blue page, that is where letters are."""

REFUSED = {
    "text.pdf": (b"hello", "the file is no PDF"),
    "cut.pdf": (b"%PDF-1.4\n1 0 obj\n", "cannot be read, as it is damaged"),
    "locked.pdf": (LOCKED, "needs a password; save it without one"),
    "long.pdf": (paper(*[(9, 9, (0, 0, 0))] * 2001), "has 2001 pages, and 2000 are read"),
}


LEAF = "void (globalThis.leafing = setInterval(() => {}, 1000))"
NEXT = LEAF.replace("{}", "document.querySelector('#next').click()")
BEFORE = LEAF.replace("{}", "dispatchEvent(new KeyboardEvent('keydown', { key: 'PageUp' }))")
"""Turn to the last page and to the first; again where a page that took a busy machine too long was given up."""
REST = "clearInterval(leafing)"

REFUSING = """(async () => {
  const { Paper } = await import('/static/paper.js');
  const { draw } = Paper.prototype;
  Paper.prototype.draw = async () => { throw new Error('it is torn'); };
  document.querySelector('#before').click();
  await new Promise((resolve) => setTimeout(resolve));
  Paper.prototype.draw = draw;
  return ['#page', '#state'].map((id) => document.querySelector(id).textContent);
})()"""
"""What the page counts and tells behind a turn to a page that cannot be drawn."""

APART = """(async (encoded) => {
  const { Paper } = await import('/static/paper.js');
  const bytes = Uint8Array.from(atob(encoded), (each) => each.charCodeAt(0));
  for (;;) {
    const paper = await Paper.open(new File([bytes], 'a.pdf'));
    try {
      const before = await paper.draw(1);
      await paper.draw(2);
      return before.getContext('2d').getImageData(9, 9, 1, 1).data[2];
    } catch (error) {
      if (!error.message.includes('too long')) throw error;
    } finally {
      paper.close();
    }
  }
})"""
"""How blue a page still is when the next one has been drawn; again where a busy machine took too long."""


async def turn_pages(ada: Tab, ben: Tab) -> dict[str, object]:
    """Ben shows a PDF in place of his picture; what Ada sees of it, and what both are told."""
    found: dict[str, object] = {"before": [each for each in ben.asked if "paper.js" in each]}
    pages = paper((400, 300, (0.1, 0.1, 0.9)), (300, 400, (0.1, 0.6, 0.1)))
    await ben.ask(f"{PAPER}('{base64.b64encode(pages).decode()}', 'slides.pdf')")
    await ada.until("`${meeting.screen.board.size}` === '1920,1440'")
    await ada.until(f"({SEEN})[2] > 190 && {DARK} > 50")
    await ben.ask(NEXT)
    await ada.until(f"`${{meeting.screen.board.size}}` === '1440,1920' && ({SEEN})[2] < 70")
    await ben.ask(REST)
    found["blue"] = await ben.ask(f"{APART}('{base64.b64encode(pages).decode()}')")
    found["page"] = await ben.ask("document.querySelector('#page').textContent")
    found["last"] = await ben.ask("document.querySelector('#next').disabled")
    found["torn"] = await ben.ask(REFUSING)
    found["refused"] = {}
    for name, (content, _) in REFUSED.items():
        await ben.ask("void meeting.tell('')")
        await ben.ask(f"{PAPER}('{base64.b64encode(content).decode()}', '{name}')")
        await ben.until(
            f"'{name}' && document.querySelector('#state').textContent.startsWith('Nothing is shared')"
        )
        found["refused"][name] = await ben.ask("document.querySelector('#state').textContent")
    await ben.ask(LARGE)
    await ben.until("document.querySelector('#state').textContent.includes('65 MiB, and 64 are read')")
    await ben.ask(BEFORE)
    await ada.until(f"({SEEN})[2] > 190")
    await ben.ask(REST)
    found["loaded"] = [sum("paper.js" in each for each in tab.asked) for tab in (ada, ben)]
    return found


WISH = """(() => {{
  const share = document.querySelector('#share');
  share.value = '{}';
  share.dispatchEvent(new Event('change'));
}})()"""
STOP = """[...document.querySelectorAll('#people button:not([hidden])')].find(
  (each) => each.textContent === 'stop sharing'
).click()"""
SHARED = "document.querySelector('#shared')"


@pytest.mark.slow
@needs_chromium
def test_a_picture_a_pdf_and_a_window_reach_the_other_and_a_moderator_ends_them():
    async def run() -> dict[str, object]:
        found = {}
        async with (
            open_room(places=BARE) as place,
            chromium(*AWAKE, "--auto-accept-this-tab-capture") as browser,
        ):
            address = f"{place.address}/room/meeting#"
            async with (
                browser.open(address + place.keys.key("meeting", "moderator")) as ada,
                browser.open(address + place.keys.key("meeting", "guest")) as ben,
            ):
                for tab, name in ((ada, "Ada"), (ben, "Ben")):
                    await tab.look(width=480, height=360)
                    await come_in(tab, name)
                await ben.ask(f"void {PICTURE}")
                await ada.until("meeting.screen.board.shown && `${meeting.screen.board.size}` === '640,360'")
                await ada.until(f"(([red, green, blue]) => red > 190 && green < 70 && blue < 70)({SEEN})")
                found["told"] = await ada.ask(f"{SHARED}.textContent")
                found["told self"] = await ben.ask(f"{SHARED}.textContent")
                found |= await turn_pages(ada, ben)
                await ada.ask(STOP)
                await ben.until("document.querySelector('#pages').hidden")
                await ben.until(f"!meeting.screen.sharing.shares && {SHARED}.hidden")
                await ada.until(f"!meeting.screen.board.shown && {SHARED}.hidden")
                await ada.ask(WISH.format("window"))
                await ben.until("meeting.screen.board.shown")
                found["window"] = await ben.ask("meeting.screen.board.size")
                await ada.ask(WISH.format("nothing"))
                await ben.until("!meeting.screen.board.shown")
                # the pointer: on a key, seen by the other where the own view looks
                await ada.ask(
                    "void Object.assign(meeting.presence.walk, { x: 0, z: 2.4, heading: Math.PI, pitch: 0.1 })"
                )
                await ada.ask("dispatchEvent(new KeyboardEvent('keydown', { key: '7', code: 'Digit7' }))")
                await ben.ask("void (meeting.stage.drawing = true)")
                number = await ada.ask("meeting.own.number")
                await ben.until(f"meeting.stage.pointers.beams.get({number})")
                await ben.drawn(3)  # behind a jump to another place
                found["dot"] = await ben.ask(
                    f"meeting.stage.pointers.beams.get({number}).dot.position.toArray()"
                )
                await ada.ask("dispatchEvent(new KeyboardEvent('keydown', { key: '7', code: 'Digit7' }))")
                await ben.until(f"!meeting.stage.pointers.beams.get({number})")
                found["complaints"] = ada.complaints + ben.complaints
        return found

    found = asyncio.run(run())
    print(found)
    assert found["told"] == "Ben shares the screen"
    assert found["told self"] == "You share the screen"
    assert (found["before"], found["loaded"]) == ([], [0, 1]), (
        "the reader comes with the first PDF, and to nobody else"
    )
    assert found["blue"] > 190
    assert (found["page"], found["last"]) == ("2 of 2", True)
    assert found["torn"] == ["2 of 2", "The page before stays: it is torn."]
    for name, (_, reason) in REFUSED.items():
        assert reason in found["refused"][name], name
    assert min(found["window"]) > 0
    x, y, z = found["dot"]
    assert abs(x) < 0.02
    assert abs(z - WALL_Z_M) < 0.01
    assert abs(y - (1.6 + (2.4 - z) * 0.1003)) < 0.02
    assert not found["complaints"]
