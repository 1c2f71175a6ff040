"""Files that are no certificates: one clear sentence, little time and memory, from both checkers and the command."""

import json
import os
import subprocess
import sys
import tracemalloc
from collections.abc import Callable, Iterator
from itertools import chain
from pathlib import Path
from typing import Any

import pytest
from certificate_subjects import subject
from certificate_tools import both, golden, golden_bytes

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed
from pkm_exact.cli.main import main

NAMES = ("3-rpr-triple", "tolerance, planar, complete")
Capture = pytest.CaptureFixture[str]


def _bytes(name: str) -> bytes:
    return canonical_bytes(sealed(subject(name) if "," in name else golden(name)))


# Bytes


@pytest.mark.parametrize("name", NAMES)
def test_a_file_cut_off_at_any_length(name: str) -> None:
    data = _bytes(name)
    lengths = {*range(60), *range(len(data) - 90, len(data)), *(2**k + d for k in range(6, 14) for d in (-1, 0, 1))}
    lengths |= {place for place, byte in enumerate(data) if byte in b"]}" and place % 5 == 0}
    for length in sorted(n for n in lengths if n < len(data)):
        answer = both(data[:length])
        assert answer.status == "malformed", length
        assert answer.lines[-1].startswith("file: ")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-32", "utf-8-sig", "cp500", "utf-7"])
def test_another_encoding(name: str, encoding: str) -> None:
    data = _bytes(name).decode("ascii").encode(encoding)
    answer = both(data)
    assert answer.status == ("malformed" if data != _bytes(name) else "accepted")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("text", ["é", "\u00a0", "\x00", "\x1b[31m", "\ud7ff", "٣", "１"])
def test_characters_beyond_the_printable_ascii_ones(name: str, text: str) -> None:
    data = _bytes(name).replace(b'"unit": "', b'"unit": "' + text.encode("utf-8"), 1)
    assert both(data).status == "malformed"


@pytest.mark.parametrize("text", ["é", '"', "\\", "\x7f", "/", "\n", "\\u0041", "\ud800", "a b", "<&>", "\U0001f600"])
def test_characters_that_are_escaped_and_others_that_are_not(text: str) -> None:
    content = golden("3-rpr-triple")
    content["notes"] = [text, f"{text} a {text}"]
    data = canonical_bytes(sealed(content))
    assert both(data).status == "accepted"
    spelled = json.dumps(text).encode()[1:-1]
    for other in (text.encode("utf-8", "surrogatepass"), "".join(f"\\u{ord(c):04x}" for c in text).encode()):
        if other != spelled:
            assert both(data.replace(spelled, other)).status != "accepted"


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    "tail", [b"x", b"\n", b" ", b"\x00", b"{}", b"\n{}\n", b",", b"]", b"}", b"\xff", b"\r\n", b"//", b"#", b"\x1a"]
)
def test_something_after_the_end_or_before_the_start(name: str, tail: bytes) -> None:
    assert both(_bytes(name) + tail).status == "malformed"
    assert both(tail + _bytes(name)).status == "malformed"


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    "number",
    [
        *("1.0", "1e0", "1E0", "10e-1", "0.1e1", "1e400", "1e-400", "1e999999999", "1.", ".1", "+1", "01", "-01", "-1"),
        *("-0", "0x1", "1_0", "1,0", "Infinity", "-Infinity", "NaN", "nan", "true", "null", '"1"', "[1]", "1 1", ""),
        *("9" * 13, "-" + "9" * 12, "9" * 5000, "1" + "0" * 10**6),
    ],
)
def test_a_number_in_another_spelling(name: str, number: str) -> None:
    data = _bytes(name).replace(b'"version": 1,', f'"version": {number},'.encode(), 1)
    assert both(data).status in ("malformed", "rejected")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1.5", "1e3", "-0", "9" * 20, "01"])
def test_such_numbers_with_a_digest_of_their_own(name: str, number: str) -> None:
    """The digest fits the bytes as they stand, so that it is the spelling that is refused."""
    from hashlib import sha256

    body = {key: value for key, value in json.loads(_bytes(name)).items() if key != "digest"}
    raw = canonical_bytes(body).replace(b'"version": 1,', f'"version": {number},'.encode(), 1)
    digest = f',\n "digest": "sha256:{sha256(raw).hexdigest()}"\n}}\n'
    assert both(raw.removesuffix(b"\n}\n") + digest.encode()).status in ("malformed", "rejected")


def _doubled(data: bytes) -> Iterator[bytes]:
    """The file with a key twice, at several depths; the second time it could pass unnoticed."""
    for key in (b'"version": 1,', b'"kind": "3-RPR",', b'"name": null,'):
        if key in data:
            yield data.replace(key, key + b"\n " + key, 1)
    lines = data.split(b"\n")
    for number, line in enumerate(lines):
        if b'": ' in line and line.endswith(b","):
            yield b"\n".join([*lines[: number + 1], line, *lines[number + 1 :]])


@pytest.mark.parametrize("name", NAMES)
def test_a_key_occurs_twice(name: str) -> None:
    count = 0
    for data in _doubled(_bytes(name)):
        answer = both(data)
        assert (str(answer.status), answer.lines) == ("malformed", ("file: a key occurs twice in one object",))
        count += 1
    assert count > 10


@pytest.mark.parametrize("opening", [b"[", b'{"a":', b'[{"digest":', b'{"digest": "x", "a": [', b'{"a":{"digest":'])
@pytest.mark.parametrize("depth", [50, 900, 5000, 400_000])
def test_deep_nesting(opening: bytes, depth: int) -> None:
    assert both(opening * depth).status in ("malformed", "too-large")
    closing = bytes({ord("["): ord("]"), ord("{"): ord("}")}[byte] for byte in reversed(opening) if byte in b"[{")
    answer = both(opening * depth + b"0" + closing * depth)
    assert answer.status in ("malformed", "too-large", "rejected")


def test_a_deeply_nested_entry_of_a_certificate() -> None:
    for depth in (100, 3000, 100_000):
        data = golden_bytes("3-rpr-triple").replace(
            b'"unit": "', b'"unit": ' + b"[" * depth + b"]" * depth + b', "x": "'
        )
        assert both(data).status in ("malformed", "rejected")


@pytest.mark.parametrize("content", [b"9" * (80 << 20), b"[" + b"1," * (3 << 20) + b"1]", b'"' + b"x" * (70 << 20)])
def test_much_data_takes_little_memory(content: bytes) -> None:
    tracemalloc.start()
    assert both(content).status == "too-large"
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 1 << 20


@pytest.mark.parametrize("digits", [10**3, 10**5, 60 << 20])
def test_a_long_integer_is_not_made_a_number(digits: int) -> None:
    tracemalloc.start()
    answer = both(b'{\n "digest": ' + b"7" * digits + b"\n}\n")
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert answer.lines == ("file: an integer of more than 12 digits",)
    assert peak < 5 * digits + (1 << 20)


@pytest.mark.parametrize("path", [("robot", "base", 0, 0), ("configuration", "lengths_squared", 0)])
@pytest.mark.parametrize("text", ["9" * 601, "1/" + "9" * 601, "9" * 10**6, "1/0", "-1/0", "2/4", "-2/4", "0/5", "3/1"])
def test_long_and_unreduced_fractions(path: tuple[str | int, ...], text: str) -> None:
    for name in NAMES:
        content: Any = json.loads(_bytes(name))
        entry = content
        for key in path[:-1]:
            entry = entry[key]
        entry[path[-1]] = text
        answer = both(canonical_bytes(sealed(content)))
        assert answer.status == ("too-large" if len(text) > 600 else "malformed"), answer


# Files, by the command and by the second checker alone


def _command(path: Path) -> int:
    return main(["check", str(path)])


def _pure_command(path: Path) -> int:
    return main(["check", "--pure", str(path)])


def _alone(path: Path) -> int:
    return pure.main([str(path)])


COMMANDS = (_command, _pure_command, _alone)
Made = Callable[[Path], None]


def _loop(path: Path) -> None:
    path.symlink_to(path.name)


def _link_to(target: str) -> Made:
    return lambda path: path.symlink_to(target)


def _link_to_a_pipe(path: Path) -> None:
    os.mkfifo(path.with_name("pipe"))
    path.symlink_to("pipe")


ODD: dict[str, Made] = {
    "missing": lambda _: None,
    "pipe": lambda path: os.mkfifo(path),
    "link to a pipe": _link_to_a_pipe,
    "link to itself": _loop,
    "link to nothing": _link_to("nowhere"),
    "link to a device that never ends": _link_to("/dev/zero"),
    "link to an empty device": _link_to("/dev/null"),
    "link to a terminal": _link_to("/dev/tty"),
    "name too long": lambda _: None,
}


@pytest.mark.skipif(sys.platform == "win32", reason="has neither pipes nor devices as files")
@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("kind", ODD)
def test_what_is_no_regular_file_is_not_read(kind: str, command: Any, tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / ("x" * 300 if "long" in kind else "odd.json")
    ODD[kind](path)
    assert command(path) == 2
    captured = capsys.readouterr()
    assert not captured.out
    assert captured.err.count("\n") == 1
    assert "cannot be read (" in captured.err
    assert captured.err.endswith("; give the path of a certificate\n")


@pytest.mark.parametrize("command", COMMANDS)
def test_a_folder_without_certificates(command: Any, tmp_path: Path, capsys: Capture) -> None:
    assert command(tmp_path) == 2
    captured = capsys.readouterr()
    assert not captured.out
    assert captured.err.count("\n") == 1
    assert "give the path of a certificate" in captured.err


@pytest.mark.parametrize("command", COMMANDS)
def test_a_link_to_a_certificate_is_followed(command: Any, tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "target.json").write_bytes(golden_bytes("3-rpr-triple"))
    (tmp_path / "link.json").symlink_to("target.json")
    assert command(tmp_path / "link.json") == 0
    assert "accepted" in capsys.readouterr().out


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("size", [64 << 20, (64 << 20) + 1, 1 << 30, 1 << 40])
def test_a_file_with_a_hole(command: Any, size: int, tmp_path: Path, capsys: Capture) -> None:
    """Zero bytes as far as the eye can see; the file takes no room on the disk."""
    path = tmp_path / "sparse.json"
    with path.open("wb") as stream:
        stream.truncate(size)
    assert command(path) == 2
    assert ("malformed" if size == 64 << 20 else "too-large") in capsys.readouterr().out


@pytest.mark.parametrize("words", [["-m", "pkm_exact.certify.pure"], ["-m", "pkm_exact.cli.main", "check"]])
def test_an_integer_of_a_gigabyte(words: list[str], tmp_path: Path) -> None:
    """The file says {"digest": 777..., a gigabyte of it; whatever is read fits into 400 MiB."""
    path = tmp_path / "long.json"
    with path.open("wb") as stream:
        stream.write(b'{"digest": ')
        for _ in range(65):
            stream.write(b"7" * (1 << 20))
        stream.truncate(1 << 30)
    limited = "import resource, runpy, sys; resource.setrlimit(resource.RLIMIT_AS, (400 << 20, 400 << 20)); "
    limited += f"sys.argv = {[words[1], *words[2:], str(path)]!r}; "
    limited += f"runpy.run_module({words[1]!r}, run_name='__main__')"
    done = subprocess.run([sys.executable, "-c", limited], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 2, done.stderr
    assert done.stdout.splitlines()[-1].endswith(": too-large")
    assert not done.stderr


def test_names_of_files_are_printed_safely(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "a\x1b[2J\nb.json"
    path.write_bytes(b"{}\n")
    for command in COMMANDS:
        assert command(path) == 2
        captured = capsys.readouterr()
        assert "\x1b" not in chain.from_iterable((captured.out, captured.err))
        assert all(line.count("malformed") <= 1 for line in captured.out.splitlines())


def test_python_may_be_set_to_read_few_digits() -> None:
    """A form with a number of 700 digits, which is not the one of its data: it was an exception."""
    content = golden("2-ups-u")
    content["robot"]["constraints"][0]["forms"][0][0] = "1" * 700
    script = "import sys; from pkm_exact.certify import check; print(check.check_bytes(sys.stdin.buffer.read()).status)"
    done = subprocess.run(
        [sys.executable, "-c", script],
        input=canonical_bytes(sealed(content)),
        env=os.environ | {"PYTHONINTMAXSTRDIGITS": "640"},
        capture_output=True,
        check=True,
    )
    assert done.stdout.decode().strip() == "rejected"
