"""What the page says to its person can be read, and holds: a lock, a refusal, a mute, the end of a meeting."""

import asyncio
from contextlib import suppress

import pytest

from room.protocol.answers import Changed
from tests.browser import Tab, chromium, needs_chromium
from tests.room.bare_place import BARE
from tests.room.guests import SOON_S, open_room
from tests.room.page import AWAKE, UNDRAWN, come_in
from tests.room.test_sharing import PICTURE, WISH

pytestmark = [needs_chromium, pytest.mark.slow]

STATE = "document.querySelector('#state').textContent"
ASKED = "Remove Ben? Their tab stays out; by the link they come in as somebody new, unless you lock the room."

CAMERA = """void (() => {
  const { presence } = meeting, { move } = presence, line = document.querySelector('#state');
  presence.camera = { word: 'No face is seen by the camera.', face: () => undefined, close() {} };
  globalThis.moves = 0;
  presence.move = (now) => (++globalThis.moves, move.call(presence, now));
  globalThis.said = [];
  new MutationObserver(() => said.push([line.textContent, performance.now()])).observe(line, { childList: true });
})()"""
"""A camera that has something to say; the page counts its own moves, and notes what it says and when."""
KEPT_MS = 14_000
"""A notice is there for 15 s."""

LATE = """void ((media) => {
  const ask = media[%r].bind(media);
  media[%r] = (wish) => new Promise((resolve) => (globalThis.give = resolve))
    .then(() => ask(wish)).then((stream) => (globalThis.given = stream));
})(navigator.mediaDevices)"""
"""A person who answers the browser's question for a device or a window when the test says so."""

STOPPED = "globalThis.given?.getTracks().every(({ readyState }) => readyState === 'ended')"

JOIN = """(() => {
  const form = document.querySelector('#join');
  form.elements.name.value = 'Ada';
  if (form.elements.voice.checked) form.elements.voice.click();
  form.elements.camera.checked = true;
  form.requestSubmit();
})()"""
WRITTEN = "document.querySelector('#chat input').value"
SUBMIT = """document.querySelector('#chat input').value ||= 'hello', document.querySelector('#chat').requestSubmit()"""


def test_a_camera_that_has_something_to_say_lets_notices_be_read():
    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            async with browser.open(
                f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            ) as tab:
                await come_in(tab, "Ada")
                await tab.ask(CAMERA)
                await tab.until(f"{STATE}.startsWith('No face')")
                chair = await place.guest(moderator=True, name="Chair")
                await chair.say(kind="moderate", action="lock")
                await tab.until("said.some(([text]) => text.includes('locked the room'))")
                await tab.ask("void (globalThis.moves = 0)")
                await tab.until("moves > 10")
                (_, began), *later = await tab.ask(
                    "said.slice(said.findIndex(([text]) => text.includes('locked')))"
                )
                assert not later or later[0][1] - began > KEPT_MS, later

    asyncio.run(run())


@pytest.mark.parametrize("goes", ["refused", "by leaving"])
def test_a_camera_that_opens_after_the_end_is_closed_and_the_last_word_stays(goes):
    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            key = "A" * 22 if goes == "refused" else place.keys.key("meeting", "guest")
            async with browser.open(f"{place.address}/room/meeting#{key}") as tab:
                await tab.until("document.querySelector('#join select[name=avatar]')?.value")
                await tab.ask(UNDRAWN)
                await tab.ask(LATE % ("getUserMedia", "getUserMedia"))
                await tab.ask(JOIN)
                await tab.until("globalThis.give")
                if goes == "by leaving":
                    await tab.until("document.querySelector('#people li')")
                    await tab.ask("document.querySelector('#leave').click()")
                await tab.until("document.querySelector('nav').hidden")
                word = await tab.ask(STATE)
                assert "link" in word or word.startswith("You have left")
                await tab.ask("void give()")
                await tab.until("globalThis.meeting")  # behind the camera
                await tab.until(STOPPED)
                assert await tab.ask(STATE) == word

    asyncio.run(run())


def test_a_window_that_was_chosen_too_slowly_is_told_in_words_of_ours():
    refused = """void (navigator.mediaDevices.getDisplayMedia = async () => {
      throw new DOMException('', 'InvalidStateError');
    })"""

    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await come_in(tab, "Ada")
                await tab.ask(refused)
                await tab.ask(WISH.format("window"))
                await tab.until(f"{STATE}.endsWith('choose once more.')")

    asyncio.run(run())


def test_a_window_that_is_given_after_the_end_is_not_captured():
    async def run() -> None:
        accept = "--auto-accept-this-tab-capture"
        async with open_room(places=BARE) as place, chromium(*AWAKE, accept) as browser:
            async with browser.open(
                f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            ) as tab:
                await come_in(tab, "Ada")
                await tab.ask(LATE % ("getDisplayMedia", "getDisplayMedia"))
                await tab.ask(WISH.format("window"))
                await tab.until("globalThis.give")
                await tab.ask("document.querySelector('#leave').click()")
                await tab.ask("void give()")
                await tab.until(STOPPED)
                assert not await tab.ask("meeting.screen.sharing.shares || meeting.screen.board.shown")
                assert (await tab.ask(STATE)).startswith("You have left")

    asyncio.run(run())


def test_who_is_muted_shares_nothing_and_is_told():
    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            async with browser.open(
                f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            ) as tab:
                await come_in(tab, "Ada")
                chair = await place.guest(moderator=True, name="Chair")
                number = await tab.ask("meeting.own.number")
                await tab.ask("void (globalThis.taken = 0)")
                await tab.ask(
                    "void ((sharing) => { const { still } = sharing; sharing.still = (picture) => {"
                    " ++globalThis.taken; still.call(sharing, picture); }; })(meeting.screen.sharing)"
                )
                await chair.say(kind="moderate", action="mute", number=number)
                await tab.until("meeting.known.get(meeting.own.number).person.muted")
                assert "nobody hears you" in await tab.ask(STATE)
                await tab.ask(f"void {PICTURE}")
                await tab.until(f"{STATE}.includes('nothing is shared')")
                assert await tab.ask("globalThis.taken") == 0, "it is refused before anything is taken"
                # a mute that the page hears of only after it has taken the picture
                await tab.ask("void Object.defineProperty(meeting.people, 'self', { value: undefined })")
                await tab.ask("void meeting.tell('')")
                await tab.ask(f"void {PICTURE}")
                await tab.until(f"{STATE}.includes('has muted you')")
                assert await tab.ask("globalThis.taken") == 1
                assert not await tab.ask("meeting.screen.sharing.shares || meeting.screen.board.shown")
                assert not any(changed.person.shares for changed in chair.all(Changed))

    asyncio.run(run())


def test_a_line_that_is_not_sent_stays_and_so_does_what_a_hand_is_on():
    """The list is changed in place: a slider that is dragged, a button with the keyboard's focus."""

    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'moderator')}"
            async with browser.open(link) as tab:
                await come_in(tab, "Ada")
                ben = await place.guest(name="Ben")
                await tab.until("document.querySelectorAll('#people li').length === 2")
                await tab.ask(
                    "void (globalThis.mute = document.querySelectorAll('#people li')[1].querySelector('button'))"
                )
                await tab.ask("globalThis.mute.focus()")
                await ben.say(kind="voice", open=True)
                await tab.until(
                    "!document.querySelector('#people').textContent.includes('Benmicrophone off')"
                )
                assert await tab.ask("document.activeElement === globalThis.mute")
                await tab.ask("void (meeting.line.open = false)")
                await tab.ask(SUBMIT)
                assert await tab.ask(f"{STATE}.startsWith('Not sent')")
                assert await tab.ask(WRITTEN) == "hello"
                await tab.ask("void (meeting.line.open = true)")
                await tab.ask(SUBMIT)
                assert await tab.ask(WRITTEN) == ""
                await tab.ask("meeting.hear({ kind: 'notice', text: 'that was too fast', about: 'chat' })")
                assert await tab.ask(WRITTEN) == "hello"

    asyncio.run(run())


async def _loaded_anew(tab: Tab) -> None:
    """Until the page answers that is there after a reload: one that goes answers no more."""
    while True:
        with suppress(AssertionError):
            if await tab.ask("Boolean(document.querySelector('#word')?.textContent.includes('not whole'))"):
                return
        await asyncio.sleep(0.1)


def test_a_browser_without_pictures_is_told_before_anything_is_asked():
    async def run() -> None:
        async with open_room() as place, chromium("--disable-3d-apis") as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await tab.until("document.querySelector('#word')?.textContent.includes('WebGL')")
                assert await tab.ask("document.querySelector('#join button').disabled")
                # the whole link in the same tab is another try, as after half of one
                await tab.ask("void (location.hash = 'half')")
                await asyncio.wait_for(_loaded_anew(tab), SOON_S)

    asyncio.run(run())


def test_what_fails_behind_come_in_can_be_read():
    forgets = "void (Storage.prototype.getItem = () => { throw new Error('no storage'); })"

    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await tab.until("document.querySelector('#join select[name=avatar]')?.value")
                await tab.ask(forgets)
                await tab.ask(JOIN)
                await tab.until("document.querySelector('#word').textContent.includes('no storage')")
                assert await tab.ask("document.querySelector('#word').checkVisibility()")

    asyncio.run(run())


def test_a_microphone_that_is_unplugged_is_told_to_all():
    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await come_in(tab, "Ada")
                ben = await place.guest(name="Ben")
                await tab.until("meeting.microphone?.isOpen")
                await tab.ask(
                    "void meeting.microphone.stream.getAudioTracks()[0].dispatchEvent(new Event('ended'))"
                )
                await tab.until(f"{STATE}.startsWith('Your microphone is gone')")
                assert await tab.ask("document.querySelector('#mute').textContent") == "No microphone"
                await ben.told(
                    Changed, lambda answer: answer.person.name == "Ada" and not answer.person.voice
                )

    asyncio.run(run())


def test_a_camera_that_is_pulled_out_is_told_and_hides_no_word_of_the_microphone():
    gone = "void meeting.%s.getTracks()[0].dispatchEvent(new Event('ended'))"

    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await come_in(tab, "Ada")
                await tab.ask("meeting.watch()")
                await tab.ask(gone % "presence.camera.stream")
                await tab.until(f"{STATE}.startsWith('Your camera is gone')")
                await tab.ask(gone % "microphone.stream")
                await tab.until(f"{STATE}.startsWith('Your microphone is gone')")

    asyncio.run(run())


def test_a_raised_hand_and_a_voice_that_does_not_come_are_told_in_words():
    words = "document.querySelector('#people').textContent"

    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'moderator')}"
            async with browser.open(link) as tab:
                await come_in(tab, "Chair")
                ben = await place.guest(name="Ben")  # no browser, so nothing ever answers its call
                await ben.say(kind="voice", open=True)
                await ben.move(animation=5)
                await tab.until(f"{STATE} === 'Ben raises a hand.'")
                await tab.until(f"{words}.includes('Benraises a hand')")
                await ben.move(animation=0, sequence=1, time_ms=40)
                await tab.until(f"!{words}.includes('raises a hand')")
                await tab.until(f"{words}.includes('Benvoice does not arrive')")
                await tab.ask("void meeting.tell('')")
                await tab.until(f"{STATE}.startsWith('No voice arrives from Ben: ')")

    asyncio.run(run())


def test_nobody_is_removed_by_one_click():
    remove = "[...document.querySelectorAll('#people button')].find((it) => it.ariaLabel === 'remove: Ben').click()"
    answers = "void (globalThis.confirm = (text) => (globalThis.asked = text, %s))"

    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'moderator')}"
            async with browser.open(link) as tab:
                await come_in(tab, "Chair")
                ben = await place.guest(name="Ben")
                await tab.until("meeting.known.size === 2")
                await tab.ask(
                    "void ((say) => (meeting.line.say = (it) => say(globalThis.said = it)))"
                    "(meeting.line.say.bind(meeting.line))"
                )
                await tab.ask(answers % "false")
                await tab.ask(remove)
                assert await tab.ask("asked") == ASKED
                await place.guest(name="Cem")
                await tab.until("meeting.known.size === 3")
                await tab.ask(answers % "true")
                await tab.ask(remove)
                await tab.until("meeting.known.size === 2")
                assert await tab.ask("said.id") == ben.welcome.id, "a number may be another's by then"

    asyncio.run(run())


def test_who_takes_a_moderators_name_is_told_from_them():
    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await come_in(tab, "Ada")
                for count, moderator in enumerate((True, False), start=1):
                    chair = await place.guest(name="Chair", moderator=moderator)
                    await chair.say(kind="chat", text="hello")
                    await tab.until(f"document.querySelectorAll('#lines li').length === {count}")
                told = await tab.ask(
                    "[...document.querySelectorAll('#lines li')].map((it) => it.textContent).join('|')"
                )
                assert told == "Chair moderator hello|Chair 2 hello"

    asyncio.run(run())


def test_a_camera_that_gives_no_pictures_is_told():
    stuck = "void (HTMLMediaElement.prototype.play = () => new Promise(() => undefined))"

    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await come_in(tab, "Ada")
                await tab.ask(stuck)
                await tab.ask("meeting.watch()")
                await tab.ask("void (meeting.presence.camera.begun -= 10000)")  # so long ago
                await tab.until(f"{STATE}.startsWith('Your camera gives no pictures')")

    asyncio.run(run())


def test_a_microphone_that_cannot_begin_is_let_go_of():
    broken = """void ((media, ask) => {
      media.getUserMedia = async (wish) => (globalThis.given = await ask(wish));
      AudioWorklet.prototype.addModule = () => Promise.reject(new Error('no such module'));
      const { voice } = document.querySelector('#join').elements;
      if (voice.checked) voice.click();
      voice.click();
    })(navigator.mediaDevices, navigator.mediaDevices.getUserMedia.bind(navigator.mediaDevices))"""

    async def run() -> None:
        async with open_room(places=BARE) as place, chromium(*AWAKE) as browser:
            link = f"{place.address}/room/meeting#{place.keys.key('meeting', 'guest')}"
            async with browser.open(link) as tab:
                await tab.until("document.querySelector('#join select[name=avatar]')?.value")
                await tab.ask(broken)
                await tab.until("document.querySelector('#word').textContent.includes('no such module')")
                assert await tab.ask(STOPPED)
                assert not await tab.ask("document.querySelector('#join').elements.voice.checked")

    asyncio.run(run())
