"""What stands behind ``--to``: names, addresses, options, and receivers that are away."""

import contextlib
import re
import socket
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.track.sinks.receivers import acted, lost, received, receiver
from track.cli.sending import open_sinks
from track.errors import InputError
from track.sinks.targets import SINKS, Target, open_sink, parse_target
from track.sinks.udp import resolved

UDP = [name for name, kind in SINKS.items() if kind.port is not None]


@pytest.mark.parametrize(
    ("text", "target"),
    [
        ("vmc", Target(name="vmc", host="127.0.0.1", port=39539)),
        ("vmc:192.168.1.5:39540", Target(name="vmc", host="192.168.1.5", port=39540)),
        ("vmc:desk.local", Target(name="vmc", host="desk.local", port=39539)),
        ("livelink::12345", Target(name="livelink", host="127.0.0.1", port=12345)),
        ("livelink:[::1]", Target(name="livelink", host="::1", port=11111)),
        (
            "livelink:[fe80::1%eth0]:9,angles=half-turns,subject=Ann B:1",
            Target(
                name="livelink",
                host="fe80::1%eth0",
                port=9,
                options={"angles": "half-turns", "subject": "Ann B:1"},
            ),
        ),
        ("vmc:[fe80::1%br-lan.100]", Target(name="vmc", host="fe80::1%br-lan.100", port=39539)),
        ("vmc,names=vrm1", Target(name="vmc", host="127.0.0.1", port=39539, options={"names": "vrm1"})),
        ("csv:takes/a, b=c.csv", Target(name="csv", place="takes/a, b=c.csv")),
        ("csv:C:\\takes\\a.csv", Target(name="csv", place="C:\\takes\\a.csv")),
    ],
)
def test_what_is_understood(text, target):
    assert parse_target(text) == target


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("osc", "there is no sink 'osc'; vmc, livelink,"),
        ("", "there is no sink ''"),
        ("vmc:::1", "[IPV6]:PORT"),
        ("vmc:fe80::1:39539", "[IPV6]:PORT"),
        ("vmc:http://x", "is no address"),
        ("vmc:host:0", "there is no port 0; 1 to 65535"),
        ("vmc:host:65536", "there is no port 65536"),
        ("vmc:host:port", "is no address"),
        ("vmc,names=vrm2", "names is 'vrm2'; both or perfect-sync or vrm0 or vrm1 are allowed"),
        ("vmc,colour=red", "vmc has no option 'colour'; names, emotions, neck are known"),
        ("vmc,vrm1", "',vrm1' is no option"),
        ("csv", "csv needs a file; write csv:FILE"),
        ("csv:", "csv needs a file"),
    ],
)
def test_what_is_refused(text, said):
    with pytest.raises(InputError) as refused:
        parse_target(text)
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


SECRET = "k" * 22 + "." + "s" * 22


@pytest.mark.parametrize(
    "text",
    [
        f"{name}{place}#{SECRET}{behind}"
        for name in ("room:", "room,", "romm:", "vmc:", "")
        for place in ("https://me:sss@127.0.0.1:9/room/x", "127.0.0.1:9/room/x", "[::1")
        for behind in ("", ",cert=c.pem", ",crt=c.pem", ",names=vrm2")
    ],
)
def test_no_secret_of_a_link_is_told(text):
    said: list[str] = []
    with contextlib.ExitStack() as closing:
        try:
            open_sinks([("--to", parse_target(text))], said.append, closing, closing)
        except InputError as refused:
            said.append(str(refused))
    assert said
    assert not re.search("sss|kkk", " ".join(said))


@given(text=st.text(max_size=40) | st.builds("vmc:{}".format, st.text(max_size=40)))
def test_any_text_is_a_target_or_a_sentence(text):
    try:
        target = parse_target(text)
    except InputError:
        return
    assert target.name in SINKS
    assert (target.port is None) == bool(target.place)


def test_a_host_that_nobody_knows_is_one_sentence():
    with pytest.raises(InputError, match=r"host 'nobody\.invalid' is not known"):
        open_sink(parse_target("vmc:nobody.invalid"), pytest.fail)


@pytest.mark.parametrize("name", UDP)
def test_a_receiver_that_is_away_costs_nothing_and_is_met_when_it_comes(name):
    with receiver() as taken:
        port = taken.getsockname()[1]
    sink = open_sink(parse_target(f"{name}:127.0.0.1:{port}"), pytest.fail)
    before = time.process_time()
    for number in range(100):
        sink.send(acted(number))  # each is refused by the system: nobody listens there
    assert (time.process_time() - before) / 100 < 0.01
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", port))
        taken.settimeout(30)
        sink.send(acted())
        assert received(taken, 1)
    sink.send(lost())
    sink.close()


@pytest.mark.parametrize("name", UDP)
def test_targets_may_have_ipv6_addresses(name):
    try:
        with receiver("::1") as taken:
            sink = open_sink(parse_target(f"{name}:[::1]:{taken.getsockname()[1]}"), pytest.fail)
            sink.send(acted())
            assert received(taken, 1)
            sink.close()
    except OSError as error:
        pytest.skip(f"this machine has no IPv6: {error}")


def test_a_network_that_takes_nothing_is_told_once():
    told = []
    sink = open_sink(parse_target("vmc:255.255.255.255"), told.append)  # broadcasting was not asked for
    for _ in range(3):
        sink.send(acted())
    sink.close()
    assert len(told) == 1
    assert "nothing can be sent" in told[0]


def test_several_at_once_get_the_same_sample(tmp_path):
    with receiver() as first, receiver() as second:
        texts = [
            f"vmc::{first.getsockname()[1]}",
            f"livelink::{second.getsockname()[1]}",
            f"csv:{tmp_path / 'a.csv'}",
        ]
        sinks = [open_sink(parse_target(text), pytest.fail) for text in texts]
        for sink in sinks:
            sink.send(acted())
            sink.close()
        assert received(first, 1)
        assert received(second, 1)
    assert len((tmp_path / "a.csv").read_text().splitlines()) == 2


@pytest.mark.parametrize("order", [1, -1])
def test_a_name_of_both_kinds_is_sent_to_by_ipv4(monkeypatch, order):
    """Receivers as VSeeFace listen by IPv4, and Windows names ::1 first."""
    both = [
        (socket.AF_INET6, socket.SOCK_DGRAM, 17, "", ("::1", 39539, 0, 0)),
        (socket.AF_INET, socket.SOCK_DGRAM, 17, "", ("127.0.0.1", 39539)),
    ][::order]
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_, **__: both)
    assert resolved(parse_target("vmc:localhost")) == (socket.AF_INET, ("127.0.0.1", 39539))


def test_an_address_of_ipv6_stays_one():
    family, (host, *_) = resolved(parse_target("vmc:[::1]:5"))
    assert (family, host) == (socket.AF_INET6, "::1")
