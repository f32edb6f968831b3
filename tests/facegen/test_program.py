"""Every end of a program has its exit code, and every fault is one line; a traceback never ends in 1."""

import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.console import MOST_CHARACTERS, one_line
from facegen.redaction import text_without_secrets
from tests.facegen.cli.commands import ROOT

PROGRAM = """
import sys, time
from pathlib import Path
from facegen.errors import InputError, InvalidData, OutputError
from facegen.program import program, run
import typer

app = program("masks", about="Masks.", libraries=())

@app.command()
def make(count: int = 1, out: Path = Path("x")) -> None:
    BODY

@app.command()
def other() -> None:
    pass

run(app, extras=())
"""


FULL = "no space left; free some and run the same command again"

FAULTS = (
    "{}['key']",
    "raise EOFError('cut')",
    "raise RecursionError('a\\nb')",
    "from facegen import typo",
    "import typo",
)


def called(body: str, *arguments: str, **options) -> subprocess.CompletedProcess:
    environment = {**os.environ, "TMPDIR": str(options.pop("tmpdir", "/nowhere")), "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, "-c", PROGRAM.replace("BODY", body), *(arguments or ("make",))],
        **{"capture_output": True, "text": True, "timeout": 60, "env": environment, **options},
    )


@pytest.mark.parametrize(
    ("body", "code", "sentence"),
    [
        ("pass", 0, ""),
        ("raise typer.Exit(1)", 1, ""),
        ("sys.exit(75)", 75, ""),
        ("raise InputError('a.csv: is empty')", 2, "masks: a.csv: is empty\n"),
        ("raise InvalidData('a')", 1, "masks: a\n"),
        ("raise OutputError('a')", 74, "masks: a\n"),
        ("raise InputError('a\\nb' + 'c' * 9999 + '\\x1b[2J do this')", 2, None),
        ("raise KeyboardInterrupt", 75, "masks: stopped; run the same command again\n"),
        (
            "raise OSError(28, 'full', 'a.csv')",
            74,
            "masks: a.csv: no space left; free some and run the same command again\n",
        ),
        *(
            (
                f"import errno; raise OSError(errno.{name}, 'no', 'a.csv')",
                2,
                "masks: a.csv: cannot be reached (no); name another\n",
            )
            for name in ("ENAMETOOLONG", "ELOOP", "EACCES")
        ),
    ],
)
def test_ends_have_their_codes(body, code, sentence):
    ended = called(body)
    assert ended.returncode == code, ended.stderr
    if sentence is None:
        assert len(ended.stderr) == MOST_CHARACTERS + 1
        assert ended.stderr.startswith("masks: a bccc")
        assert ended.stderr.endswith("\\x1b[2J do this\n")
    else:
        assert ended.stderr == sentence


@pytest.mark.parametrize(
    "body", ["{}['key']", "raise RecursionError('a\\nb')", "from facegen import typo", "import typo"]
)
def test_the_unforeseen_is_one_line_and_its_traceback_in_a_file(tmp_path, body):
    ended = called(body, tmpdir=tmp_path)
    assert ended.returncode == 70
    match = re.fullmatch(
        r"masks: internal error \(\w+: .*\); details are in (\S+masks-fault-\S+\.txt); please report it with them\n",
        ended.stderr,
    )
    details = Path(match[1]).read_text()
    assert "Traceback (most recent call last)" in details
    assert "['-c', 'make']" in details
    assert Path(match[1]).stat().st_mode & 0o077 == 0


@pytest.mark.parametrize(
    ("word", "repeated"),
    [
        ("mouth=rtsp://me:pa=ss@camera.local/live?password=word", "sys.argv[-1]"),
        ("mouth=rtsp://me:pa=ss@camera.local/live", "sys.argv[-1][6:]"),
        ("mouth=rtsp://me:pa=ss@camera.local/live,fps=60", "sys.argv[-1][6:-7]"),
        ("mouth=rtsp://me:a pa=ss@camera.local/live,fps=60", "sys.argv[-1][6:-7]"),
        ("mouth=rtsp://me:a pa=ss@camera.local/live#left", "sys.argv[-1][6:-5]"),
        (r"rtsp://me:\pa=ss@camera.local/live", "repr(sys.argv[-1])"),
        (r"rtsp://me:a\ pa=ss@camera.local/live", "repr(sys.argv[-1])"),
        ("room:https://camera.local/room/x#password=word.word.word", "sys.argv[-1][5:]"),
        ("room:camera.local/room/x#password=word.word.word", "sys.argv[-1][5:]"),
        ("97", "'http://me:pa=ss@camera.local/live, and http://camera.local/?password=word'"),
    ],
)
def test_what_is_to_be_reported_holds_no_password(tmp_path, word, repeated):
    """Neither among the words that the program was called with nor where a library's message repeats a part of one."""
    ended = called(f"raise RuntimeError({repeated})", "make", "--out", word, tmpdir=tmp_path)
    assert ended.returncode == 70
    (details,) = tmp_path.glob("masks-fault-*.txt")
    for told in (details.read_text(), ended.stderr):
        assert "camera.local" in told
        assert not re.search("pa=ss|word=", told)


@given(
    before=st.text(st.characters(codec="ascii", exclude_characters="\0")),
    address=st.text(st.characters(codec="ascii", categories=["L", "N", "P", "S"])),
    secret=st.sampled_from(
        ["://me:pa=ss@", "://camera.local/?user=me&password=word", "#" + "password=word" * 2]
    ),
)
def test_no_address_in_a_text_holds_a_password(before, address, secret):
    assert not re.search("pa=ss|word=", text_without_secrets(f"{before}http{secret}{address} failed", []))


def test_a_fault_without_a_place_for_details_says_where_it_was(tmp_path):
    ended = called("{}['key']", preexec_fn=_no_files_larger_than_nothing)
    assert ended.returncode == 70
    assert ended.stderr.startswith("masks: internal error (KeyError: 'key'); in ")
    assert ended.stderr.count("\n") == 1


def _no_files_larger_than_nothing() -> None:
    import resource

    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))


def test_memory_that_runs_out_is_told(tmp_path):
    ended = called("bytearray(2**62)", tmpdir=tmp_path)
    assert ended.returncode == 70
    assert ended.stderr.startswith(
        "masks: memory ran out; give it more, or less to do at once (details are in "
    )


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (("make", "--count", "many"), "masks: Invalid value for '--count': it should be a "),
        (("make", "--cuont", "1"), "masks: No such option: --cuont (Possible options: --count"),
        (("make", "--helm"), "masks: No such option: --helm; see"),
        (("fly",), "masks: No such command 'fly'; see"),
        (("make", "--count"), "masks: Option '--count' requires an argument; see"),
        (("make", "--count", "1" * 5000), "masks: Invalid value for '--count': "),
    ],
)
def test_wrong_words_are_one_line(words, sentence):
    ended = called("pass", *words)
    assert ended.returncode == 2
    assert ended.stderr.startswith(sentence)
    assert ended.stderr.count("\n") == 1
    assert len(ended.stderr) <= MOST_CHARACTERS + 1
    assert ended.stderr.endswith(f"; see masks {'make ' if words[0] == 'make' else ''}--help\n")


def test_without_words_there_is_help():
    ended = subprocess.run(
        [sys.executable, "-c", PROGRAM.replace("BODY", "pass")],
        capture_output=True,
        text=True,
        cwd=ROOT,
        timeout=60,
    )
    assert ended.returncode == 2
    assert "Usage: " in ended.stdout + ended.stderr


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_with_75(number):
    body = "print('ready', flush=True); time.sleep(60)"
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM.replace("BODY", body), "make"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        cwd=ROOT,
    )
    assert process.stdout.readline() == "ready\n"
    process.send_signal(number)
    _, talk = process.communicate(timeout=30)
    assert (process.returncode, talk) == (75, "masks: stopped; run the same command again\n")


def test_a_full_standard_output_is_told():
    with open("/dev/full", "w") as full:
        ended = called("print('a' * 100_000)", stdout=full, stderr=subprocess.PIPE, capture_output=False)
    assert ended.returncode == 74
    assert ended.stderr == f"masks: standard output: {FULL}\n"


def test_a_reader_who_goes_is_no_error():
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM.replace("BODY", "print('a' * 10_000_000)"), "make"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        cwd=ROOT,
    )
    process.stdout.read(1)
    process.stdout.close()
    with process.stderr as talk:
        assert talk.read() == b""
    assert process.wait(timeout=30) == 0


def test_closed_streams_are_no_fault():
    ended = called("print('a')", preexec_fn=lambda: (os.close(1), os.close(0)), stdin=None)
    assert (ended.returncode, ended.stderr) == (0, "")


def test_a_name_that_is_no_text_comes_out_as_it_is():
    ended = called("print(out)", "make", "--out", os.fsdecode(b"caf\xe9"), text=False)
    assert (ended.returncode, ended.stdout) == (0, b"caf\xe9\n")
    refused = called("raise InputError(f'{out}: is empty')", "make", "--out", os.fsdecode(b"caf\xe9"))
    assert refused.stderr == "masks: caf\\udce9: is empty\n"


@given(st.text())
def test_any_message_is_one_printable_line(message):
    line = one_line(message)
    assert len(line) <= MOST_CHARACTERS
    assert line.isprintable()


@given(st.text(st.characters(categories=["L", "N", "P"]), max_size=MOST_CHARACTERS))
def test_a_short_message_stays_as_it_is(message):
    assert one_line(message) == message


def test_the_end_of_a_long_message_stays():
    line = one_line("a" * 400 + "b" * 400 + "; do this")
    assert len(line) == MOST_CHARACTERS
    assert line.startswith("a" * 330)
    assert line.endswith("b; do this")


@pytest.mark.parametrize("program", ["facegen", "regress"])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_stop_while_modules_load_is_one_line(program, number, tmp_path):
    # as a compiled module that makes an ImportError of whatever is raised while it loads
    (tmp_path / "typer.py").write_text(
        f"import os\ntry:\n    os.kill(os.getpid(), {int(number)})\n    print('went on')\n"
        "except BaseException:\n    raise ImportError('initialization failed') from None\n"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), str(ROOT)])}
    done = subprocess.run([sys.executable, "-m", program], env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (75, "")
    assert done.stderr == f"{program}: stopped; run the same command again\n"


@pytest.mark.parametrize("value", ["inf", "-inf", "nan", "1e999", "Infinity"])
def test_a_number_that_is_not_finite_is_refused(value):
    command = [sys.executable, "-m", "facegen", "develop", "no", "--out", "no", "--exposure", value]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.startswith("facegen: ")
    assert done.stderr.count("\n") == 1


def test_a_program_answers_stops_before_it_loads_what_children_need():
    asked = "import sys, facegen.program; print('multiprocessing' in sys.modules)"
    shown = subprocess.run([sys.executable, "-c", asked], cwd=ROOT, capture_output=True, text=True)
    assert shown.stdout == "False\n", shown.stderr
