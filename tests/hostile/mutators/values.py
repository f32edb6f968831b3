"""Values that no option expects."""

from random import Random

NUMBERS = (
    *(
        "nan",
        "inf",
        "-inf",
        "1e400",
        "-1",
        "0",
        "-0",
        "1e-320",
        "1e308",
        "99999999999999999999",
        "7" * 5_000,
        "0x10",
    ),
    *(
        "1_000",
        "٣",
        "²",
        "1,5",
        "",
        " ",
        "x",
        "1e5",
        "2147483648",
        "9223372036854775808",
        "18446744073709551616",
        "1.5",
    ),
)
RANGES = (
    *(
        "",
        "-",
        "0-",
        "-5",
        "5-0",
        "0-99999999999",
        "0-9999999999999999999999",
        "0,,1",
        "0-3:0",
        "0-3:-1",
        "²",
        "٣-٤",
        "x",
    ),
    *(
        ",".join(["0"] * 100_000),
        "0-1:" + "9" * 5_000,
        "9" * 5_000,
        "0-1-2",
        " 0 - 1 ",
        "nan",
        "0:1",
        "1" * 20,
        "none",
    ),
)
WORDS = (
    *(
        "",
        " ",
        "x",
        "x" * 100_000,
        "../x",
        "/",
        "/dev/null",
        "a\nb",
        "\udcff",
        "é",
        "{{x}}",
        "$(id)",
        "'",
        '"',
        "%s",
        "-",
    ),
    *(
        "--help",
        "\x1b[31m",
        "NUL",
        "a/b",
        ".",
        "..",
        "x" * 256,
        "0",
        "__class__",
        "a=b",
        "=",
        "a=",
        "=b",
        "*",
        "~",
    ),
)
VALUES = {"number": NUMBERS, "range": RANGES, "word": WORDS}


def value_of(kind: str, random: Random) -> str:
    """A value for an option of this kind; every third time of another kind."""
    return random.choice(VALUES[kind if random.random() < 0.67 else random.choice(sorted(VALUES))])
