"""Help, versions and completion: every command shows examples that work, and docs/cli.md has every option."""

import re
import shlex
import shutil
import subprocess
import sys
from importlib import metadata
from pathlib import Path

import click
import pytest
from doc_samples import blocks, commands

import pkm_exact
from pkm_exact.cli.commands import COMMANDS, certify_poses, command
from pkm_exact.cli.main import COMPLETIONS, PROGRAM, ROOTS, ExitCode, main

ROOT = Path(__file__).parent.parent
REFERENCE = ROOT / "docs" / "cli.md"
Capture = pytest.CaptureFixture[str]

PATH = "l1,l2,l3,l4,l5,l6\n1250,1250,1250,1250,1250,1250\n1250.5,1250,1250,1250,1250,1250\n"
CUBE = "[region]\nposition = [[-9, 9], [-9, 9], [760, 780]]\nrpy_degrees = [0, 0, 0]\n"
CUBE += "[conditions]\nno_type_2 = true\n[answer]\nkind = 'all'\n"
SLOW = ("", "check", "compare", "formulations", "plot", "sweep")
LARGEST = "formulations"
NOT_HERE = ("tcp://", " view ")  # need a cluster, or a reader at the browser
POSES = """x,y,theta,l1,l2,l3
5,5,0,7.085,5.106,5.035
5,6,40,7.827,8.772,2.566
6,5,-40,7.814,2.615,7.540
3,4,25,5.020,6.610,3.540
5,3,60,5.828,7.100,4.502
7,6,30,9.231,8.006,4.914
4,7,-50,8.067,5.217,5.036
6,4,-20,7.217,2.660,7.385
"""


HELPS = {"": certify_poses, **{name: command(name) for name in COMMANDS}}


def _examples(command: click.Command) -> list[str]:
    """The command lines below "Examples:" in the help as it is shown."""
    shown = command.get_help(click.Context(command, info_name=PROGRAM, max_content_width=200, terminal_width=200))
    block = re.search(r"^ +Examples?:\n((?: +.+\n)+)", shown, re.MULTILINE)
    return [line.strip() for line in block[1].splitlines()] if block else []


def _marks(name: str) -> list[pytest.MarkDecorator]:
    return [*([pytest.mark.slow] if name in SLOW else []), *([pytest.mark.largest] if name == LARGEST else [])]


EXAMPLES = [pytest.param(name, marks=_marks(name), id=name or PROGRAM) for name in HELPS]


@pytest.mark.parametrize("name", HELPS)
def test_every_help_has_examples(name: str) -> None:
    command = HELPS[name]
    examples = _examples(command)
    assert examples
    for example in examples:
        assert example.startswith(f"{PROGRAM} {name}".strip() + ("" if name else " "))
    for parameter in command.params:
        assert isinstance(parameter, click.Argument) or parameter.help, parameter.name  # type: ignore[attr-defined]
    assert command.help
    assert command is certify_poses or command.short_help


@pytest.mark.parametrize("name", EXAMPLES)
def test_every_example_of_a_help_works(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    """In the order in which they are shown, in a folder that has models/, certs/ and the reader's own files."""
    for folder in ("models", "certs"):
        shutil.copytree(ROOT / folder, tmp_path / folder)
    for file in ("path.csv", "lengths.csv"):
        (tmp_path / file).write_text(PATH)
    (tmp_path / "angles.csv").write_text("h1,h2,h3\n10deg,0deg,1/4\n")
    (tmp_path / "plan.csv").write_text("x,y,half_tangent\n5,4,0\n6,3,1/3\n2,9,-1/2\n7,7,2\n")
    (tmp_path / "cube.toml").write_text(CUBE)
    (tmp_path / "poses.csv").write_text(POSES)
    monkeypatch.chdir(tmp_path)
    for example in _examples(HELPS[name]):
        if any(word in example for word in NOT_HERE):
            continue
        line, _, target = example.partition(" > ")
        code = main(shlex.split(line)[1:])
        out, err = capsys.readouterr()
        expected = ExitCode.WEAKER_CLAIM if "--method newton" in line else ExitCode.DONE
        assert code == expected, (example, out, err)
        if target:
            Path(target).write_text(out)


def test_versions_begin_with_our_own(capsys: Capture) -> None:
    assert main(["--version"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == f"certify-poses {pkm_exact.__version__}"
    text = "\n".join(lines)
    for name in ("python-flint", "numpy", "mpmath", "sympy", "click", "rich"):
        assert f"{name} {metadata.version(name)}" in text
    assert ".".join(map(str, sys.version_info[:3])) in text
    assert re.search(r"FLINT \d+\.\d+", text)
    assert "certificates of version 1" in text


def test_versions_without_flint_and_numpy(monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    """A broken installation can still say what it has."""
    known = metadata.version

    def version(name: str) -> str:
        if name == "numpy":
            raise metadata.PackageNotFoundError(name)
        return known(name)

    monkeypatch.setattr(metadata, "version", version)
    monkeypatch.setitem(sys.modules, "flint", None)
    assert main(["--version"]) == 0
    out = capsys.readouterr().out
    assert "numpy missing" in out
    assert "cannot be loaded" in out


def test_one_version_everywhere() -> None:
    assert f'version = "{pkm_exact.__version__}"' in (ROOT / "pyproject.toml").read_text()
    assert f"version: {pkm_exact.__version__}" in (ROOT / "CITATION.cff").read_text()
    assert f"## [{pkm_exact.__version__}]" in (ROOT / "CHANGELOG.md").read_text()


def _completions(words: str, monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> list[str]:
    """What the program answers when bash asks how the last of the words goes on."""
    program = words.split(" ")[0]
    monkeypatch.setenv(COMPLETIONS[program], "bash_complete")
    monkeypatch.setenv("COMP_WORDS", words)
    monkeypatch.setenv("COMP_CWORD", str(len(words.split(" ")) - 1))
    assert main([], program) == 0
    return capsys.readouterr().out.split()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("certify-poses fo", ["plain,formulations"]),
        ("certify-poses solve --conf", ["plain,--configuration"]),
        ("certify-poses solve --method k", ["plain,krawczyk"]),
        ("certify-poses solve mod", ["file,mod"]),
        ("certify-poses solve models/hexa.toml -o x", ["file,x"]),
        (f"certify-poses solve {ROOT}/models/hexa.toml --configuration ", ["plain,home", "plain,level"]),
        (f"certify-poses solve --width 1 {ROOT}/models/hexa.toml --configuration le", ["plain,level"]),
        ("certify-poses solve missing.toml --configuration ", []),
        ("certify-poses solve --configuration ", []),
        ("certify-poses completion ", ["plain,bash", "plain,zsh", "plain,fish"]),
        ("certify-roots che", ["plain,check", "file,che"]),
        ("certify-roots circle.ms --or", ["plain,--oracle"]),
        ("certify-roots solve circle.ms --oracle m", ["plain,msolve"]),
        ("certify-roots check cert", ["file,cert"]),
    ],
)
def test_completion(words: str, expected: list[str], monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    assert _completions(words, monkeypatch, capsys) == expected


def test_a_foreign_question_is_no_question(monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    monkeypatch.setenv(COMPLETIONS[PROGRAM], "powershell_complete")
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.startswith("certify-poses")


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_completion_in_bash(tmp_path: Path) -> None:
    """The printed script, sourced, with the words as bash hands them over."""
    program = tmp_path / PROGRAM
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m pkm_exact.cli.main "$@"\n')
    program.chmod(0o755)
    script = f"""
        PATH={tmp_path}:$PATH
        source <(certify-poses completion bash)
        COMP_WORDS=(certify-poses solve {ROOT}/models/hexa.toml --configuration l); COMP_CWORD=4
        _certify_poses_completion certify-poses; echo "${{COMPREPLY[@]}}"
        complete -p certify-poses
    """
    done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True, cwd=ROOT)
    lines = done.stdout.splitlines()
    assert lines[0] == "level"
    assert "_certify_poses_completion" in lines[1]


@pytest.mark.parametrize("program", [PROGRAM, ROOTS])
@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_scripts_are_valid(shell: str, program: str, tmp_path: Path, capsys: Capture) -> None:
    assert main(["completion", shell], program) == 0
    script = capsys.readouterr().out
    assert f"{COMPLETIONS[program]}={shell}_complete" in script
    assert program in script
    if shutil.which(shell):
        path = tmp_path / "script"
        path.write_text(script)
        subprocess.run([shell, "-n", str(path)], check=True)


@pytest.mark.parametrize("name", HELPS)
def test_the_reference_has_every_command_and_option(name: str) -> None:
    """docs/cli.md: a section for each command, and in it every option with each of its names."""
    sections = re.split(r"^## ", REFERENCE.read_text(encoding="utf-8"), flags=re.MULTILINE)
    found = [section for section in sections if re.match(rf"`{PROGRAM} {name}`".replace(" `", "`"), section)]
    assert len(found) == 1, f"docs/cli.md: add one section ## `{PROGRAM} {name}`"
    command = HELPS[name]
    for parameter in command.params:
        if isinstance(parameter, click.Option):
            for option in parameter.opts:
                assert re.search(rf"`{option}[`, ]", found[0]), f"docs/cli.md, {name}: add {option}"
        else:
            metavar = parameter.make_metavar(click.Context(command)).strip("[].")
            assert metavar in found[0], f"docs/cli.md, {name}: add {metavar}"
    if name:
        lines = [line for block in blocks(found[0]) if block.language == "sh" for _, line, _ in commands(block)]
        assert any(line.startswith(f"{PROGRAM} {name}") for line in lines), f"docs/cli.md, {name}: add an example"


def test_the_reference_has_no_option_that_is_gone() -> None:
    sections = re.split(r"^## ", REFERENCE.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
    for section in sections:
        match = re.match(rf"`{PROGRAM} ?(\w*)`", section)
        if match:
            command = HELPS[match[1]]
            known = {name for parameter in command.params for name in parameter.opts} | {"-h", "--help"}
            rows = re.findall(r"^\| `(-[^`]*)`", section, flags=re.MULTILINE)
            assert {word for row in rows for word in re.findall(r"--?[a-z][a-z-]*", row)} <= known


def test_every_exit_code_is_in_the_reference() -> None:
    text = REFERENCE.read_text(encoding="utf-8")
    assert {int(code) for code in re.findall(r"^\| (\d+) \|", text, flags=re.MULTILINE)} >= {*ExitCode, 143}


def test_an_empty_path_is_named(capsys: Capture) -> None:
    model = str(ROOT / "models" / "3-rrr.toml")
    for words in (["solve", model, "-o", ""], ["solve", ""], ["export", model, "--to", "msolve", "-o", ""]):
        assert main(words) == 2
        err = capsys.readouterr().err
        assert "the path '' is empty; give the path of a file" in err
        assert err.count("\n") == 1


def test_a_path_with_a_null_character_is_named(capsys: Capture) -> None:
    for words in (["solve", "\0"], ["check", "\0"], ["plot", "\0", "-o", "x.png"], ["report", "\0", "-o", "x.html"]):
        assert main(words) == 2
        assert "has a null character; give the path of a file" in capsys.readouterr().err
