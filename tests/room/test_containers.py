"""What containers/room starts, started here by the real programs: the recipes were written where no container runs."""

import asyncio
import ipaddress
import re
import shutil
import subprocess
import time
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import aiohttp
import pytest
import typer
import yaml

from room.cli import app
from room.protocol.answers import Left
from room.server import load_keys
from room.server.turn import Relays
from tests.room.avatars import avatar
from tests.room.engines import free_port, needs_redis, redis, started
from tests.room.guests import Place
from tests.room.test_chaos import server
from tests.room.test_several import bring

ROOM = Path(__file__).resolve().parents[2] / "containers" / "room"
COMPOSE = yaml.safe_load((ROOM / "compose.yaml").read_text(encoding="utf-8"))
SERVICES = COMPOSE["services"]


def test_every_file_that_compose_names_is_there():
    for service in SERVICES.values():
        recipe = (ROOM / service["build"]["context"] / service["build"]["dockerfile"]).resolve()
        for line in recipe.read_text(encoding="utf-8").splitlines():
            if line.startswith("COPY "):
                for source in line.split()[1:-1]:
                    assert (ROOM.parents[1] / source).exists(), source
        for secret in service.get("secrets", ()):
            assert secret in COMPOSE["secrets"]
        command = " ".join(service["command"])
        assert set(re.findall(r"/run/secrets/(\w+)", command)) == set(service.get("secrets", ()))
        for name in re.findall(r"/etc/room/([\w./]+)", command):
            assert (ROOM / name).exists(), name


def test_compose_starts_a_server_of_rooms_with_options_that_it_has():
    serve = typer.main.get_command(app).commands["serve"]
    known = {option for parameter in serve.params for option in parameter.opts}
    for name in ("room-1", "room-2"):
        subcommand, *options = SERVICES[name]["command"]
        assert subcommand == "serve"
        assert {option.partition("=")[0] for option in options} <= known
    addresses = " ".join(SERVICES["room-1"]["command"])
    assert all(host in SERVICES for host in re.findall(r"=(?:redis|ws)://(\w+):", addresses))


def test_ports_that_are_published_are_those_of_the_settings():
    janus = (ROOM / "janus" / "janus.jcfg").read_text()
    assert re.search(r'rtp_port_range = "([\d-]+)"', janus)[1] in SERVICES["janus"]["ports"][0]
    coturn = dict(
        line.split("=", 1) for line in (ROOM / "turnserver.conf").read_text().splitlines() if "-port=" in line
    )
    assert f"{coturn['min-port']}-{coturn['max-port']}:" in SERVICES["coturn"]["ports"][2]
    assert coturn["listening-port"] + ":" in SERVICES["coturn"]["ports"][0]
    assert "ports" not in SERVICES["redis"], "Redis has no door to the outside"
    assert not any("8188" in port for port in SERVICES["janus"]["ports"]), "nor has what commands Janus"


@needs_redis
def test_redis_starts_as_compose_starts_it():
    port = free_port()
    with started(*SERVICES["redis"]["command"], "--port", str(port), port=port):
        pass


needs_coturn = pytest.mark.skipif(shutil.which("turnserver") is None, reason="needs coturn (Debian: coturn)")


def _relayed(folder: Path, settings: str, peers: Iterable[str], password: str = "") -> list[str]:
    """What a page's browser hears of a running coturn when it asks for a way to each peer."""
    port = free_port()
    (folder / "turnserver.conf").write_text(settings)
    here = ("--listening-ip", "127.0.0.1", "--relay-ip", "127.0.0.1", "--listening-port", str(port))
    files = ("--pidfile", f"{folder}/pid", "--userdb", f"{folder}/users", "--log-file", f"{folder}/log")
    own = ("-c", str(folder / "turnserver.conf"), "--static-auth-secret", "north")
    relay = Relays(turn=("turn:b:2",), secret="north").servers("ada", now_s=time.time())[0]

    def client(peer: str) -> str:
        command = (
            "turnutils_uclient",
            "-p",
            str(port),
            "-u",
            relay.username,
            "-w",
            password or relay.credential,
        )
        with suppress(subprocess.TimeoutExpired):
            done = subprocess.run(
                [*command, "-n", "1", "-c", "-e", peer, "127.0.0.1"],
                capture_output=True,
                text=True,
                timeout=20,
            )
            return done.stdout + done.stderr
        return ""

    with started("turnserver", *own, *here, *files, port=port):
        return [client(peer) for peer in peers]


FORBIDDEN = "error 403 (Forbidden IP)"


@needs_coturn
def test_a_running_coturn_takes_the_credentials_of_a_page_and_no_others(tmp_path):
    """With the settings that stand here; and it passes nothing on to machines of private networks."""
    settings = (ROOM / "turnserver.conf").read_text()
    peers = (
        "10.1.2.3",
        "172.16.0.1",
        "192.168.1.1",
        "100.64.0.1",
        "169.254.169.254",
        "192.0.2.1",
        "198.18.0.1",
    )
    for answer in _relayed(tmp_path, settings, peers):
        assert "Cannot complete Allocation" not in answer
        assert FORBIDDEN in answer
    assert "Cannot complete Allocation" in _relayed(tmp_path, settings, ["10.1.2.3"], "guess")[0]
    bare = "".join(line for line in settings.splitlines(True) if "10.0.0.0" not in line)
    # coturn holds addresses of IPv4 against ranges of IPv6 too, and one that began with :: took them all
    assert FORBIDDEN not in _relayed(tmp_path, bare, ["10.1.2.3"])[0], "it is the settings that forbid it"


def test_coturn_is_told_of_every_network_that_is_not_of_all():
    """Of both families; Python knows the registry of the numbers' authority."""
    lines = (ROOM / "turnserver.conf").read_text().splitlines()
    told = [line.partition("=")[2].split("-") for line in lines if line.startswith("denied-peer-ip=")]
    ranges = [(ipaddress.ip_address(first), ipaddress.ip_address(last)) for first, last in told]
    private = (
        *(
            "0.0.0.1",
            "10.0.0.1",
            "100.64.0.1",
            "100.127.255.255",
            "127.0.0.1",
            "169.254.169.254",
            "172.31.255.255",
        ),
        *("192.0.0.8", "192.0.2.1", "192.168.0.1", "198.19.0.1", "198.51.100.1", "203.0.113.1", "224.0.0.1"),
        *("240.0.0.1", "255.255.255.255", "::1", "::ffff:10.0.0.1", "64:ff9b::a00:1", "64:ff9b:1::1"),
        *("2001::1", "2001:db8::1", "2002:a00:1::", "fc00::1", "fd12::1", "fe80::1", "fec0::1", "ff02::1"),
    )
    for text in private:
        address = ipaddress.ip_address(text)
        assert any(first.version == address.version and first <= address <= last for first, last in ranges), (
            f"{text} is passed on to"
        )
    for text in ("1.1.1.1", "100.128.0.1", "172.32.0.1", "193.0.0.1", "2606:4700::1", "2a00::1"):
        address = ipaddress.ip_address(text)
        assert not any(
            first.version == address.version and first <= address <= last for first, last in ranges
        )


@pytest.mark.slow
@needs_redis
@pytest.mark.skipif(
    not (shutil.which("haproxy") and shutil.which("openssl")), reason="needs haproxy and openssl (Debian)"
)
def test_whose_server_is_killed_comes_back_at_the_same_address(tmp_path):
    """HAProxy with the settings that stand here, two servers by https, Redis: one server is killed."""
    ports, wire, front = [free_port(), free_port()], free_port(), free_port()
    made = ("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")
    files = ("-out", tmp_path / "cert.pem", "-keyout", tmp_path / "key.pem")
    subprocess.run([*made, "-days", "1", "-subj", "/CN=localhost", *files], check=True, capture_output=True)
    options = ("--cert", str(tmp_path / "cert.pem"), "--key", str(tmp_path / "key.pem"))
    settings = (ROOM / "haproxy.cfg").read_text().replace("bind :8443", f"bind 127.0.0.1:{front}")
    for number, port in enumerate(ports, 1):
        settings = settings.replace(f"room-{number}:8443", f"127.0.0.1:{port}")
    (tmp_path / "haproxy.cfg").write_text(settings)

    async def run(first: subprocess.Popen) -> None:
        place = Place(f"https://127.0.0.1:{front}", load_keys(tmp_path / "room.keys"))
        await place.session.close()
        place.session = aiohttp.ClientSession(connector=aiohttp.TCPConnector(ssl=False, force_close=True))
        north, south = (Place(f"https://127.0.0.1:{port}", place.keys) for port in ports)
        for straight in (north, south):
            await straight.session.close()
            straight.session = place.session
        # an own avatar comes by another connection, and has to reach the server where its person is
        for name in ("Cara", "Dan", "Eve", "Finn"):
            guest = await place.guest(name=name)
            await bring(place, guest, avatar())
            await guest.go()
        ada, ben = await north.guest(), await south.guest(name="Ben")  # the first is killed
        await ada.move(floor_m=(3.0, 4.0))
        await ben.until(lambda: ada.number in ben.states)
        first.kill()
        await ada.end()
        start = time.monotonic()
        again = None
        while again is None:
            with suppress(aiohttp.ClientError):
                again = await place.guest(secret=ada.secret)
        print(f"back after {time.monotonic() - start:.1f} s")
        assert time.monotonic() - start < 20, "4 on a machine that does nothing else"
        assert again.number == ada.number
        assert not ben.all(Left)
        await place.session.close()

    with (
        redis(wire),
        server(tmp_path, ports[0], "--redis", f"redis://127.0.0.1:{wire}/0", *options) as first,
        server(tmp_path, ports[1], "--redis", f"redis://127.0.0.1:{wire}/0", *options),
        started("haproxy", "-f", str(tmp_path / "haproxy.cfg"), port=front),
    ):
        time.sleep(2.5)  # until HAProxy has seen both
        asyncio.run(run(first))
