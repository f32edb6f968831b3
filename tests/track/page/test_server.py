"""The page's server with real WebSockets: what it tells, what it refuses, and who may look."""

import asyncio
import json
import socket
import threading
import time
from contextlib import asynccontextmanager

import aiohttp
import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES
from facegen.errors import InputError
from regress.runtime.sample import Sample
from tests.hanging_up import hang_up
from track.messages import Command, Moment, Step
from track.page import Page, frames
from track.page.commands import MOST_GAIN, MOST_MESSAGE_BYTES, Seen, read_command
from track.page.guard import Guard
from track.page.server import FRAMES_PER_SECOND, MOST_VIEWERS, PICTURES_PER_SECOND
from track.page.viewer import UNSEEN_FRAMES

STEPS = ("neutral", "jaw_open")
TOKEN = "a-token-that-nobody-guesses"

SOON_S = 60.0
"""What is awaited comes in milliseconds; a slow machine with other work is given time."""


def moment(value: float = 0.25, *, pictures: bool = False, **changes: object) -> Moment:
    weights = np.full(52, value)
    weights[BLENDSHAPES.index("tongueOut")] = np.nan
    sample = Sample(
        time_s=1.5,
        weights=weights,
        gaze=np.array([0.1, -0.1, 0.1, -0.1]),
        head=np.array([0.01, 0.02, 0.6, 0.1, 0.2, 0.3]),
    )
    shown = {"camera": np.full((48, 64, 3), (10, 200, 30), np.uint8)} if pictures else {}
    return Moment(sample=sample, pictures=shown, points={"camera": np.array([[12.34, np.nan]])}, **changes)


@asynccontextmanager
async def tab(page: Page, **headers: str):
    """A browser's tab that has been greeted, and its greeting."""
    async with aiohttp.ClientSession() as session:
        address = page.url.replace("http:", "ws:").replace("/?", "/stream?")
        address = address if "?" in address else address + "stream"
        async with session.ws_connect(address, headers=headers) as socket:
            yield socket, json.loads(await socket.receive_str(timeout=SOON_S))


async def until(condition) -> None:
    end = time.monotonic() + SOON_S
    while not condition():
        assert time.monotonic() < end, "it never came"
        await asyncio.sleep(0.005)


@pytest.fixture
def asked():
    return []


@pytest.fixture
def page(asked):
    with Page(asked.append, steps=STEPS) as page:
        yield page


def test_a_tab_is_greeted_and_gets_what_is_published(page):
    async def look():
        async with tab(page) as (socket, hello):
            assert hello["shapes"] == list(BLENDSHAPES)
            assert hello["cameras"] == ["camera"]
            assert hello["steps"] == list(STEPS)
            assert not hello["shared"]
            step = Step(name="neutral", state="countdown", seconds_left=2.0, text="Rest")
            page.publish(
                moment(
                    fps=29.5,
                    latency_ms={"p50": 21.0, "p95": np.float64("nan")},
                    faults=("The camera shows nobody.",),
                    step=step,
                    settings={"mirror": True, "gains": {"jawOpen": np.float32(1.5)}},
                )
            )
            return json.loads(await socket.receive_str(timeout=SOON_S))

    frame = asyncio.run(look())
    assert frame["weights"][:51] == [0.25] * 51
    assert frame["weights"][51] is None
    assert frame["head"] == [0.01, -0.02, -0.6, 0.1, 0.2, 0.3]
    assert frame["gaze"] == [0.1, -0.1, 0.1, -0.1]
    assert frame["latency"] == {"p50": 21.0, "p95": None}
    assert frame["step"] == {"name": "neutral", "state": "countdown", "seconds_left": 2.0, "text": "Rest"}
    assert frame["settings"] == {"mirror": True, "gains": {"jawOpen": 1.5}}
    assert (frame["fps"], frame["faults"]) == (29.5, ["The camera shows nobody."])


def test_commands_arrive_and_bad_messages_are_refused_with_a_word(page, asked):
    bad = {
        "nonsense": "JSON",
        "[]": "",
        '{"verb": "explode"}': "explode",
        '{"verb": "calibrate", "value": "left_ear"}': "left_ear",
        '{"verb": "gain", "shape": "__proto__", "value": 1}': "__proto__",
        '{"verb": "gain", "shape": "jawOpen", "value": 1e9}': f"{MOST_GAIN:g}",
        '{"verb": "gain", "shape": "jawOpen", "value": NaN}': "",
        '{"verb": "mirror", "value": 1}': "mirror",
        '{"verb": "cancel", "and": "more"}': "and",
    }

    async def talk():
        async with tab(page) as (socket, _):
            for text, word in bad.items():
                await socket.send_str(text)
                answer = json.loads(await socket.receive_str(timeout=SOON_S))
                assert answer["type"] == "refused"
                assert word in answer["text"], answer
                assert "\n" not in answer["text"]
            await socket.send_bytes(b"\x00\xff")
            assert json.loads(await socket.receive_str(timeout=SOON_S))["type"] == "refused"
            await socket.send_str('{"verb": "gain", "shape": "jawOpen", "value": 1.5}')
            await socket.send_str('{"verb": "calibrate", "value": "all"}')
            await until(lambda: len(asked) == 2)

    asyncio.run(talk())
    assert asked == [Command(verb="gain", shape="jawOpen", value=1.5), Command(verb="calibrate", value="all")]


def test_what_the_session_refuses_is_told_to_the_tab():
    def refuse(command: Command) -> None:
        raise InputError("there is no face to calibrate on")

    async def talk():
        with Page(refuse) as page:
            async with tab(page) as (socket, _):
                await socket.send_str('{"verb": "recentre"}')
                return json.loads(await socket.receive_str(timeout=SOON_S))

    assert asyncio.run(talk()) == {"type": "refused", "text": "there is no face to calibrate on"}


def test_a_message_too_long_ends_its_tab_alone(page, asked):
    async def talk():
        async with tab(page) as (loud, _), tab(page) as (quiet, _):
            await loud.send_str("x" * (MOST_MESSAGE_BYTES + 1))
            answer = await loud.receive(timeout=SOON_S)
            assert answer.type is aiohttp.WSMsgType.CLOSE
            assert answer.data == aiohttp.WSCloseCode.MESSAGE_TOO_BIG
            await quiet.send_str('{"verb": "recentre"}')
            await until(lambda: asked)

    asyncio.run(talk())


@given(
    st.one_of(
        st.text(), st.recursive(st.none() | st.booleans() | st.floats() | st.text(), st.lists).map(json.dumps)
    )
)
@settings(max_examples=100, deadline=None)
def test_whatever_a_browser_says_is_a_command_or_one_sentence(text):
    sentence = ""
    try:
        heard = read_command(text, steps=STEPS)
    except InputError as error:
        heard, sentence = None, str(error)
    assert isinstance(heard, Command | Seen) or (sentence and "\n" not in sentence)


def test_pictures_come_only_while_a_tab_wants_them_and_no_more_than_it_may(page, asked):
    async def look():
        async with tab(page) as (socket, _):
            page.publish(moment(pictures=True))
            told = json.loads(await socket.receive_str(timeout=SOON_S))
            assert told["cameras"] == {"camera": {"size": [64, 48], "points": [[12.3, None]]}}
            assert not page.wants_pictures
            await socket.send_str('{"verb": "picture", "value": true}')
            await until(lambda: page.wants_pictures)
            kinds, last, begun = [], b"", time.monotonic()
            while kinds.count(aiohttp.WSMsgType.TEXT) < 30 or not last:
                page.publish(moment(pictures=True))
                message = await socket.receive(timeout=SOON_S)
                kinds.append(message.type)
                last = message.data if message.type is aiohttp.WSMsgType.BINARY else last
            pictures = kinds.count(aiohttp.WSMsgType.BINARY)
            assert 1 <= pictures <= PICTURES_PER_SECOND * (time.monotonic() - begun) + 1
            await socket.send_str('{"verb": "picture", "value": false}')
            await until(lambda: not page.wants_pictures)
        return last

    coded = asyncio.run(look())
    assert coded[0] == 0
    picture = cv2.imdecode(np.frombuffer(coded[1:], np.uint8), cv2.IMREAD_COLOR)
    assert picture.shape == (48, 64, 3)
    assert np.abs(picture.astype(int).mean(axis=(0, 1)) - (10, 200, 30)).max() < 3
    assert asked == [Command(verb="picture", value=True), Command(verb="picture", value=False)]


def test_a_tab_that_goes_no_longer_wants_pictures(page, asked):
    async def look():
        async with tab(page) as (socket, _):
            await socket.send_str('{"verb": "picture", "value": true}')
            await until(lambda: page.wants_pictures)
        await until(lambda: not page.watched and not page.wants_pictures)

    asyncio.run(look())


def test_a_slow_tab_gets_the_newest_frame_and_a_quick_one_all(page):
    async def look():
        async with tab(page) as (slow, _), tab(page) as (quick, _):
            await slow.send_str('{"verb": "seen", "value": 0}')
            quick_seen, count = [], 60
            for number in range(1, count + 1):
                page.publish(moment(number / 100))
                frame = json.loads(await quick.receive_str(timeout=SOON_S))
                quick_seen.append(frame["weights"][0])
                await quick.send_str(json.dumps({"verb": "seen", "value": frame["number"]}))
            slow_seen = [json.loads(await slow.receive_str(timeout=SOON_S)) for _ in range(UNSEEN_FRAMES)]
            with pytest.raises(asyncio.TimeoutError):
                await slow.receive(timeout=0.1)
            await slow.send_str(json.dumps({"verb": "seen", "value": slow_seen[-1]["number"]}))
            newest = json.loads(await slow.receive_str(timeout=SOON_S))
            return quick_seen, [each["weights"][0] for each in slow_seen], newest["weights"][0]

    quick, slow, newest = asyncio.run(look())
    assert quick == [number / 100 for number in range(1, 61)]
    assert slow == [0.01, 0.02]
    assert newest == 0.6


def test_a_tab_is_told_no_more_than_a_screen_draws_and_the_last_frame_always(page):
    async def look():
        async with tab(page) as (quick, _):
            begun, numbers, shown = time.perf_counter(), 0, []
            while time.perf_counter() - begun < 0.5:
                numbers += 1
                page.publish(moment(numbers / 1000))
                await asyncio.sleep(1 / 240)
            while not shown or shown[-1] != round(numbers / 1000, 4):
                shown.append(json.loads(await quick.receive_str(timeout=SOON_S))["weights"][0])
            return len(shown), time.perf_counter() - begun

    count, seconds = asyncio.run(look())
    assert count <= FRAMES_PER_SECOND * seconds + 2


def test_publishing_never_waits(page):
    """Not even for a server that is held up for as long."""
    held, published = threading.Event(), threading.Event()

    async def look():
        async with tab(page) as (socket, _):
            page._loop.call_soon_threadsafe(lambda: (held.set(), published.wait(SOON_S)))
            assert await asyncio.to_thread(held.wait, SOON_S)
            for number in range(1, 2001):
                page.publish(moment(number / 2000))
            published.set()
            while json.loads(await socket.receive_str(timeout=SOON_S))["weights"][0] < 1:
                pass

    began = time.monotonic()
    asyncio.run(look())
    assert time.monotonic() - began < SOON_S, "else the server was let go before all was published"


def test_there_is_room_for_a_few_tabs_and_a_sentence_for_the_next(page):
    async def look():
        async with aiohttp.ClientSession() as session:
            sockets = [await session.ws_connect(f"{page.url}stream") for _ in range(MOST_VIEWERS)]
            await until(lambda: len(page._viewers) == MOST_VIEWERS)
            with pytest.raises(aiohttp.WSServerHandshakeError) as refused:
                await session.ws_connect(f"{page.url}stream")
            for socket in sockets:
                await socket.close()
            return refused.value.status

    assert asyncio.run(look()) == 503


async def ask(page: Page, path: str, **headers: str) -> tuple[int, str, object]:
    async with (
        aiohttp.ClientSession() as session,
        session.get(f"http://127.0.0.1:{page.port}{path}", headers=headers) as answer,
    ):
        return answer.status, (await answer.read()).decode(errors="replace"), answer.headers


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 200),
        ({"Host": "localhost:1234"}, 200),  # a tunnel's
        ({"Host": "[::1]:80"}, 200),
        ({"Host": "evil.example"}, 403),
        ({"Host": "127.0.0.1.evil.example"}, 403),
        ({"Host": "192.168.1.7"}, 403),
        ({"Host": "[::1"}, 403),
        ({"Origin": "http://evil.example"}, 403),
        ({"Origin": "null"}, 403),
        ({"Origin": "http://["}, 403),
        ({"Host": "localhost:1", "Origin": "http://localhost:2"}, 403),
        ({"Host": "localhost:1", "Origin": "http://localhost:1"}, 200),
    ],
)
@pytest.mark.parametrize("path", ["/", "/page.js"])
def test_only_the_page_itself_is_answered(page, path, headers, status):
    assert asyncio.run(ask(page, path, **headers))[0] == status


def test_a_strange_page_gets_no_socket(page):
    async def look(**headers):
        async with tab(page, **headers):
            pass

    asyncio.run(look(Origin=f"http://127.0.0.1:{page.port}"))
    for headers in ({"Origin": "http://evil.example"}, {"Host": f"evil.example:{page.port}"}):
        with pytest.raises(aiohttp.WSServerHandshakeError):
            asyncio.run(look(**headers))


def test_another_host_asks_for_the_token_everywhere(asked):
    with Page(asked.append, host="0.0.0.0", token=TOKEN) as page:
        assert page.url == f"http://127.0.0.1:{page.port}/?token={TOKEN}"
        paths = ("/", "/avatar", "/stream")
        assert {asyncio.run(ask(page, path))[0] for path in paths} == {403}
        assert {asyncio.run(ask(page, f"{path}?token={TOKEN[:-1]}é"))[0] for path in paths} == {403}
        assert asyncio.run(ask(page, f"/?token={TOKEN}"))[0] == 200
        assert asyncio.run(ask(page, f"/?token={TOKEN}", Host="192.168.1.7:9"))[0] == 200
        assert asyncio.run(ask(page, f"/?token={TOKEN}", Host="evil.example"))[0] == 403

        async def look():
            async with tab(page) as (_, hello):
                return hello

        assert asyncio.run(look())["type"] == "hello"


def test_a_page_that_others_may_look_at_says_so(asked):
    async def greeted(page):
        async with tab(page) as (_, hello):
            return hello["shared"]

    with Page(asked.append, host="0.0.0.0") as page:
        assert page.is_shared
        assert asyncio.run(greeted(page))
    with Page(asked.append, token=TOKEN) as page:
        assert not page.is_shared
        assert not asyncio.run(greeted(page))


def test_tokens_are_made_where_they_are_needed_and_cannot_be_short():
    assert Guard.of("127.0.0.1", None).token == Guard.of("localhost", None).token == ""
    made = {Guard.of("192.168.1.7", None).token for _ in range(20)}
    assert len(made) == 20
    assert min(map(len, made)) >= 43  # 256 bits
    with pytest.raises(InputError, match="3 characters"):
        Guard.of("127.0.0.1", "abc")


def test_a_taken_port_and_a_strange_host_are_one_sentence(page):
    threads = threading.active_count()
    with pytest.raises(
        InputError, match=rf"^the page cannot listen on 127.0.0.1:{page.port} \([^\n]*\); choose [^\n]*$"
    ):
        Page(print, port=page.port)
    with pytest.raises(InputError, match=r"cannot listen on 203\.0\.113\.7:0"):
        Page(print, host="203.0.113.7")
    with pytest.raises(InputError, match="70000"):
        Page(print, port=70000)
    end = time.monotonic() + SOON_S
    while threading.active_count() > threads and time.monotonic() < end:
        time.sleep(0.01)
    assert threading.active_count() == threads


def raw_status(page, path: str) -> bytes:
    """First line of the answer to a path as it stands: clients take dots out of it before they ask."""
    with socket.create_connection(("127.0.0.1", page.port), timeout=SOON_S) as line:
        line.sendall(
            f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{page.port}\r\nConnection: close\r\n\r\n".encode()
        )
        return line.makefile("rb").readline()


def test_answers_hold_what_guards_a_browser(page):
    status, text, headers = asyncio.run(ask(page, "/"))
    assert status == 200
    policy = headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert "<script>" not in text
    assert "style=" not in text
    for path in ("/../server.py", "/page.js/../../server.py", "/%2e%2e/server.py", "//server.py"):
        assert b" 404 " in raw_status(page, path)


def test_a_tab_that_leaves_during_the_handshake_is_no_fault(page, caplog):
    async def look():
        for _ in range(50):
            hang_up(f"{page.url}stream")
        async with tab(page):
            return

    asyncio.run(look())
    assert caplog.records == []


def test_the_end_is_told_to_tabs(asked):
    async def look():
        page = Page(asked.append)
        async with tab(page) as (socket, _):
            await asyncio.to_thread(page.close)
            message = await socket.receive(timeout=SOON_S)
            page.publish(moment())
            page.close()
            return message.type, message.data, page._thread.is_alive()

    assert asyncio.run(look()) == (aiohttp.WSMsgType.CLOSE, aiohttp.WSCloseCode.GOING_AWAY, False)


def test_large_pictures_become_small_ones():
    coded = frames.jpeg(np.zeros((1080, 1920), np.uint8))
    assert cv2.imdecode(np.frombuffer(coded, np.uint8), cv2.IMREAD_UNCHANGED).shape == (360, 640)
