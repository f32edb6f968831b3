"""A name that promises another kind of file than what a command writes is refused, before anything is read."""

import importlib

import pytest
import typer

WRONG = "take.xyz"

REFUSED = {
    "facegen preview --weights none.csv": {"--out"},
    "facegen blend none.toml --sample 0": {"--out"},
    "facegen rig preview": {"--out"},
    "facegen rig landmarks": {"--out"},
    "facegen rig export": {"--out"},
    "facegen headset preview tracking3": {"--out"},
    "regress predict none.csv": {"--out", "--confidence"},
    "regress report none": {"--out", "--figures"},
    "regress edges none.npy": {"--out"},
    "regress headset predict --mouth none": {"--out", "--confidence", "--points", "--eyes", "--video"},
    "regress headset check": {"--out", "--sheet"},
    "regress headset calibrate": {"--out"},
    "regress headset compass none": {"--out"},
    "regress headset report none": {"--out", "--figures"},
    "room export none.jsonl": {"--out"},
    "room serve --port 0": {"--record"},
    "track run --camera none.webm": {"--record"},
}
"""Every option that names one file to write, of commands that would do something else next."""

NO_FILE = {
    ("facegen farm resume", "--dry-run"),
    ("facegen farm submit", "--dry-run"),
    ("regress export", "--format"),
    ("regress headset adapt", "--weights"),
}
"""Options whose words say that something is written, and which name no file."""

NEEDED = {"--figures": ("--data", "none"), "--eyes": ()}
CASES = [(command, option) for command, options in REFUSED.items() for option in sorted(options)]


@pytest.mark.parametrize(("command", "option"), CASES, ids=lambda value: value.split(" none")[0])
def test_another_ending_is_refused_with_what_is_allowed(command, option, tmp_path, monkeypatch, capsys, anny):
    monkeypatch.chdir(tmp_path)
    program, *words = command.split()
    monkeypatch.setattr("sys.argv", [program, *words, option, WRONG, *NEEDED.get(option, ())])
    with pytest.raises(SystemExit) as ended:
        importlib.import_module(f"{program}.__main__").main()
    (said,) = capsys.readouterr().err.splitlines()
    assert ended.value.code == 2, said
    for word in (WRONG, "end", " ."):
        assert word in said
    assert not list(tmp_path.iterdir())


def test_the_table_has_every_option_that_names_a_file():
    found = set()
    for program in ("facegen", "regress", "room", "track"):
        app = importlib.import_module(f"{program}.cli").app
        found |= set(_file_options(program, typer.main.get_command(app)))
    known = {
        (place, option)
        for place, option in found
        if any(command.startswith(place) and option in options for command, options in REFUSED.items())
    }
    assert found - known == NO_FILE


def _file_options(place: str, command):
    for name, inner in getattr(command, "commands", {}).items():
        yield from _file_options(f"{place} {name}", inner)
    for parameter in command.params:
        said = getattr(parameter, "help", None) or ""
        if ("rite" in said or "file for" in said) and "older" not in said:
            yield place, parameter.opts[0]
