"""C code written for a robot: it compiles without a warning, and says what the Python code says."""

import ctypes
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from following_tools import Array, precise_pose, values_at
from samples import solved

from pkm_exact import Robot, read_robot, solve_many
from pkm_exact.cli.main import main
from pkm_exact.files import write_all
from pkm_exact.following.c_files import c_files
from pkm_exact.following.follower import Followed, next_pose
from pkm_exact.following.following_start import joint_values

MODELS = Path(__file__).parent.parent / "models"
COMPILER = shutil.which("cc") or ""
Capture = pytest.CaptureFixture[str]
FLAGS = ["-std=c99", "-O2", "-Wall", "-Wextra", "-pedantic", "-Werror"]
LARGEST = [pytest.mark.slow, pytest.mark.largest]
needs_compiler = pytest.mark.skipif(not COMPILER, reason="no C compiler here")


def _library(folder: Path, robot: Robot, home: Followed) -> ctypes.CDLL:
    for name, text in c_files("r", home.tables, home, "a test").items():
        (folder / name).write_text(text)
    library = folder / "r.so"
    subprocess.run([COMPILER, *FLAGS, "-shared", "-fPIC", "r.c", "-lm", "-o", library], cwd=folder, check=True)
    return ctypes.CDLL(str(library))


def _pose_type(legs: int, size: int) -> type[ctypes.Structure]:
    double = ctypes.c_double

    class Pose(ctypes.Structure):
        _fields_ = [
            ("position", double * 3),
            ("rotation", double * 9),
            ("quaternion", double * 4),
            ("position_bound", double),
            ("rotation_bound", double),
            ("values", double * legs),
            ("point", double * size),
            ("radius", double),
        ]

    return Pose


def _doubles(values: Array) -> ctypes.Array[ctypes.c_double]:
    return (ctypes.c_double * len(values))(*map(float, values))


@needs_compiler
@pytest.mark.parametrize("name", ["3-rpr-merlet-p", "3-rrr", "hexaglide", "hexa", "ssm-exact"])
def test_the_code_says_what_python_says(name: str, tmp_path: Path) -> None:
    robot = Robot.load(MODELS / f"{name}.toml")
    home = robot.follow(joint_values(robot, robot.configuration()), solved(name).poses[-1])
    library = _library(tmp_path, robot, home)
    pose = _pose_type(len(home.values), len(home.point))()
    start = [_doubles(x) for x in (home.values, home.position, home.quaternion)]
    assert library.r_start(*start, ctypes.byref(pose)) == 1
    rng = np.random.default_rng(5)
    last = next_pose(home.tables, home.values, home)
    claims = set()
    for size in [1e-5] * 20 + [1e-3] * 20 + [1e-2] * 20:
        unit = 1.0 if home.tables.is_cranked else home.tables.unit
        values = home.values + size * unit * rng.uniform(-1, 1, len(home.values))
        claim = library.r_follow(_doubles(values), ctypes.byref(pose))
        found = next_pose(home.tables, values, last)
        assert claim == found.is_proved + found.same_mode
        claims.add(claim)
        if claim:
            last = found
            assert pose.position_bound == pytest.approx(found.position_bound, rel=0.5)
            off = np.max(np.abs(np.array(pose.position) - found.position))
            assert off <= pose.position_bound + found.position_bound
            off = np.max(np.abs(np.array(pose.rotation).reshape(3, 3) - found.rotation))
            assert off <= pose.rotation_bound + found.rotation_bound
            true = precise_pose(robot, values, found.position, found.quaternion)[0]
            assert np.max(np.abs(np.array(pose.position) - true)) <= pose.position_bound * 1.000001
            again = (ctypes.c_double * len(values))()
            assert library.r_inverse(pose.position, pose.quaternion, _doubles(values), again) == 0
            assert np.array(again) == pytest.approx(values, abs=1e-6 * unit)
    assert 2 in claims


@needs_compiler
@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("3-rpr-merlet-p", 40),
        ("rolland-6-6", 10),
        pytest.param("3-rpr-merlet-p", 10_000, marks=LARGEST),
        pytest.param("rolland-6-6", 200, marks=pytest.mark.slow),
        pytest.param("rolland-6-6", 1_000, marks=LARGEST),
    ],
)
def test_the_code_meets_one_certified_box_at_random_lengths(name: str, count: int, tmp_path: Path) -> None:
    """Of all poses certified for the very doubles one box, and no other, is within the bounds of what the code says."""
    robot = Robot.load(MODELS / f"{name}.toml")
    home = robot.follow(joint_values(robot, robot.configuration()), solved(name).poses[-1])
    library = _library(tmp_path, robot, home)
    pose = _pose_type(len(home.values), len(home.point))()
    rows = home.values * (1 + 0.002 * np.random.default_rng(count).uniform(-1, 1, (count, len(home.values))))
    certified = solve_many(robot, rows, doubles_are_exact=True)
    start = [_doubles(x) for x in (home.values, home.position, home.quaternion)]
    proved, sign = 0, precise_pose(robot, home.values, home.position, home.quaternion)[2]
    for row, values in enumerate(rows):
        assert library.r_start(*start, ctypes.byref(pose))
        claim = library.r_follow(_doubles(values), ctypes.byref(pose))
        if not claim:
            continue
        proved += 1
        boxes = certified.poses[certified.poses["row"] == row]
        met = np.ones(len(boxes), bool)
        for key, bound in (("position", pose.position_bound), ("rotation", pose.rotation_bound)):
            said = np.array(getattr(pose, key)).reshape(boxes[key].shape[1:])
            off = np.abs(boxes[key] - said) - boxes[f"{key}_half_width"] - bound
            met &= off.reshape(len(boxes), -1).max(axis=1) <= 1e-15 * np.abs(said).max()
        assert met.sum() == 1
        assert claim == 1 or boxes["det_sign"][met][0] == sign
    assert proved > count // 2


@needs_compiler
@pytest.mark.parametrize("name", ["3-prr", "mssm"])
def test_the_command_writes_files_that_compile_and_pass_their_own_test(
    name: str, tmp_path: Path, capsys: Capture
) -> None:
    folder = tmp_path / "code"
    words = ["codegen", str(MODELS / f"{name}.toml"), "-o", str(folder), "--name", "arm"]
    assert main(words) == 0
    assert capsys.readouterr().out.startswith(f"{folder}: arm.h, arm.c, arm_example.c, arm_test.c\n")
    for program in ("arm_test", "arm_example"):
        command = [COMPILER, *FLAGS, f"{program}.c", "arm.c", "-lm", "-o", program]
        subprocess.run(command, cwd=folder, check=True)
    report = subprocess.run([folder / "arm_test"], check=True, capture_output=True, text=True).stdout
    assert report.startswith("10000 poses: 10000 proved, ")
    assert ", 0 wrong; " in report
    lines = subprocess.run([folder / "arm_example"], check=True, capture_output=True, text=True).stdout.splitlines()
    assert len(lines) == 10
    assert main(words) == 2
    assert "exists; give -o another folder, or --force" in capsys.readouterr().err
    first = {path.name: path.read_bytes() for path in folder.glob("*.[ch]")}
    assert main([*words, "--force"]) == 0
    assert {path.name: path.read_bytes() for path in folder.glob("*.[ch]")} == first


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["delta.toml"], "codegen needs a robot with legs"),
        (["3-rpr-merlet-p.toml", "--name", "9x"], "--name: '9x' is no name in C"),
        (["3-rpr-merlet-p.toml", "--pose", "7"], "--pose: 7 is not among the 2 poses"),
        (["3-rpr-merlet-p.toml", "--configuration", "x"], "configuration: 'x' is unknown"),
        (["nowhere.toml"], "no such file"),
    ],
)
def test_what_cannot_be_written_gives_one_sentence_and_no_file(
    words: list[str], part: str, tmp_path: Path, capsys: Capture
) -> None:
    folder = tmp_path / "code"
    assert main(["codegen", str(MODELS / words[0]), "-o", str(folder), *words[1:]]) == 2
    _, err = capsys.readouterr()
    assert part in err
    assert err.count("\n") == 1
    assert not folder.exists()


def test_names_from_a_model_cannot_leave_their_comment() -> None:
    robot = Robot.load(MODELS / "3-rpr-merlet-p.toml")
    home = robot.follow(joint_values(robot, robot.configuration()), solved("3-rpr-merlet-p").poses[0])
    text = c_files("r", home.tables, home, "x */ int main(void) { return 1; }\n#error \\")["r.h"]
    assert text.count("*/") == c_files("r", home.tables, home, "x")["r.h"].count("*/")
    assert "\n#error" not in text


def test_the_code_begins_at_the_nominal_pose(tmp_path: Path, capsys: Capture) -> None:
    """The pose of merlet-p that is not the best conditioned one, once the model says that it is meant."""
    text = (MODELS / "3-rpr-merlet-p.toml").read_text(encoding="utf-8")
    poses = read_robot(MODELS / "3-rpr-merlet-p.toml").solve().poses
    starts = []
    for place, pose in enumerate(poses):
        x, y = (str(bound.lo) for bound in pose.position[:2])
        model = tmp_path / f"arm{place}.toml"
        model.write_text(f'{text}\n[nominal]\nposition = ["{x}", "{y}"]\ndegrees = 0\n', encoding="utf-8")
        assert main(["codegen", str(model), "-o", str(tmp_path / str(place)), "--name", "arm"]) == 0
        example = (tmp_path / str(place) / "arm_example.c").read_text(encoding="utf-8")
        starts.append(float(example.split("position[3] = {")[1].split(",")[0]))
    capsys.readouterr()
    assert starts == pytest.approx([float(pose.position[0].lo) for pose in poses])
    assert starts[0] != pytest.approx(starts[1])


def test_a_folder_that_cannot_be_made_gives_one_sentence(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "file").write_text("")
    words = ["codegen", str(MODELS / "3-rpr-merlet-p.toml"), "-o", str(tmp_path / "file" / "code")]
    assert main(words) == 2
    err = capsys.readouterr().err
    assert "cannot be written (Not a directory), so nothing was; give -o the path of another folder" in err


def test_files_are_written_all_or_none(tmp_path: Path) -> None:
    (tmp_path / "b").mkdir()
    (tmp_path / "a").write_bytes(b"before")
    with pytest.raises(OSError, match="directory"):
        write_all(tmp_path, {"a": b"1", "b": b"2", "c": b"3"})
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a", "b"]
    assert (tmp_path / "a").read_bytes() == b"before"
    with pytest.raises(OSError):  # noqa: PT011 - whatever the system says of a name that is too long
        write_all(tmp_path / "new" / "folder", {"a": b"1", "x" * 300: b"2"})
    assert not (tmp_path / "new").exists()


def _rotation(e: Array) -> Array:
    a, v = e[0], e[1:]
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    return np.asarray(np.eye(3) + 2 * (a * cross + cross @ cross) / (e @ e))


def _singular_pose(robot: Robot, home: Followed, rng: np.random.Generator) -> Array:
    """A place and a quaternion, about, at which det J of a spatial robot is 0."""
    platform = np.array(robot.platform_joints, dtype=object).astype(float)
    base = np.array(robot.base_joints, dtype=object).astype(float)
    sizes = np.append(np.full(3, home.tables.unit), np.ones(4))
    pose = np.append(home.position, home.quaternion)

    def determinant(x: Array) -> float:
        arms = platform @ _rotation(x[3:]).T
        d = x[:3] + arms - base
        return float(np.linalg.det(np.column_stack([d, np.cross(arms, d)])))

    while True:
        low, high = (pose + rng.uniform(0, 0.7) * sizes * rng.normal(size=7) for _ in range(2))
        if determinant(low) * determinant(high) < 0:
            for _ in range(60):
                middle = (low + high) / 2
                low, high = (middle, high) if determinant(low) * determinant(middle) > 0 else (low, middle)
            return np.asarray(low)


@needs_compiler
@pytest.mark.parametrize(
    "count", [50, pytest.param(1_000, marks=pytest.mark.slow), pytest.param(10_000, marks=LARGEST)]
)
def test_no_way_across_a_singularity_is_called_one_mode(count: int, tmp_path: Path) -> None:
    """Ways between poses of a hexapod on both sides of det J = 0, and along it."""
    robot = Robot.load(MODELS / "rolland-6-6.toml")
    home = robot.follow(joint_values(robot, robot.configuration()), solved("rolland-6-6").poses[-1])
    library = _library(tmp_path, robot, home)
    pose = _pose_type(len(home.values), len(home.point))()
    sizes = np.append(np.full(3, home.tables.unit), np.ones(4))
    rng = np.random.default_rng(count)
    claimed = crossed = 0
    for _ in range(count // 10):
        singular = _singular_pose(robot, home, rng)
        for _ in range(10):
            away = 10.0 ** rng.uniform(-6, -1) * sizes
            first = singular + away * rng.normal(size=7)
            last = first + away * 10.0 ** rng.uniform(-3, 1) * rng.normal(size=7)
            lengths = [values_at(robot, x[:3], _rotation(x[3:])) for x in (first, last)]
            start = [_doubles(x) for x in (lengths[0], first[:3], first[3:] / np.linalg.norm(first[3:]))]
            if not library.r_start(*start, ctypes.byref(pose)):
                continue
            ends = [(lengths[0], np.array(pose.position), np.array(pose.quaternion))]
            claim = library.r_follow(_doubles(lengths[1]), ctypes.byref(pose))
            if not claim:
                continue
            ends.append((lengths[1], np.array(pose.position), np.array(pose.quaternion)))
            signs = [precise_pose(robot, *end)[2] for end in ends]
            claimed += claim == 2
            crossed += signs[0] != signs[1]
            assert claim == 1 or signs[0] == signs[1] != 0
    assert claimed > count // 20
    assert crossed
