"""A sweep on a Dask cluster: the same bytes as without, and clear sentences where there is none."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from random import Random
from types import SimpleNamespace
from typing import Any

import pytest
from samples import MODELS

from pkm_exact.cli.main import main
from pkm_exact.sweep.cluster import ClusterWorkers
from pkm_exact.sweep.job import Answer
from pkm_exact.sweep.lengths import LengthRow

Capture = pytest.CaptureFixture[str]
MODEL = next(str(path) for path in MODELS if path.stem == "3-rpr-merlet-p")
needs_distributed = pytest.mark.skipif(find_spec("distributed") is None, reason="distributed is not installed")

# In a process of its own: Dask's warnings and its event loop do not belong to the suite.
CLUSTER = """
import sys
from distributed import LocalCluster, Scheduler
if __name__ == "__main__":
    cluster = LocalCluster(
        n_workers=int(sys.argv[1]), threads_per_worker=2, dashboard_address=None, silence_logs=50,
        local_directory=sys.argv[2],
    )
    print(cluster.scheduler_address, *(worker.pid for worker in cluster.workers.values()), flush=True)
    sys.stdin.read()
"""


class Cluster:
    """A scheduler with some workers."""

    def __init__(self, folder: Path, workers: int) -> None:
        script = folder / "cluster.py"
        script.write_text(CLUSTER)
        command = [sys.executable, str(script), str(workers), str(folder / "dask")]
        here = Path(__file__).parent
        # Workers run this very code, also where another copy is installed.
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(map(str, (here, here.parent)))}
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env=environment,
        )
        assert self.process.stdout is not None
        self.address, *pids = self.process.stdout.readline().split()
        self.workers = [int(pid) for pid in pids]
        assert all(pid > 1 for pid in self.workers)

    def close(self) -> None:
        self.process.kill()
        self.process.communicate()


@pytest.fixture(scope="module")
def dask(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    cluster = Cluster(tmp_path_factory.mktemp("cluster"), 2)
    yield cluster
    cluster.close()


def rows(folder: Path, count: int) -> Path:
    random = Random(count)
    lines = [",".join(str(random.randint(4000, 8000) / 1000) for _ in range(3)) for _ in range(count)]
    lines[3] = "7,x,5"
    path = folder / "lengths.csv"
    path.write_text("\n".join(lines))
    return path


def words(folder: Path, lengths: Path, name: str, *options: str) -> list[str]:
    return ["sweep", MODEL, str(lengths), "-o", str(folder / name), *options]


def in_process(arguments: list[str]) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "pkm_exact.cli.main", *arguments],
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
    )


def wait_for(path: Path, lines: int, process: subprocess.Popen[str]) -> None:
    end = time.monotonic() + 120
    while not path.exists() or path.read_bytes().count(b"\n") < lines:
        assert process.poll() is None
        assert time.monotonic() < end
        time.sleep(0.01)


@needs_distributed
@pytest.mark.parametrize("method", ["krawczyk", pytest.param("exact", marks=pytest.mark.slow)])
def test_a_cluster_gives_the_same_bytes(tmp_path: Path, dask: Cluster, method: str) -> None:
    lengths = rows(tmp_path, 40)
    options = ["--method", method, "--certificates"]
    assert main(words(tmp_path, lengths, "here", "--workers", "1", *options, str(tmp_path / "c1"))) == 3
    done = in_process(words(tmp_path, lengths, "there", "--scheduler", dask.address, *options, str(tmp_path / "c2")))
    error = done.communicate(timeout=120)[1]
    assert done.returncode == 3, error
    assert error.count("\n") == 1
    assert "40 rows" in error
    assert (tmp_path / "here").read_bytes() == (tmp_path / "there").read_bytes()
    for path in (tmp_path / "c1").iterdir():
        assert path.read_bytes() == (tmp_path / "c2" / path.name).read_bytes()
    assert len(list((tmp_path / "c2").iterdir())) == 39


@needs_distributed
@pytest.mark.slow
def test_killed_workers_and_clients_change_nothing(tmp_path: Path, dask: Cluster) -> None:
    lengths = rows(tmp_path, 300)
    assert main(words(tmp_path, lengths, "here", "--workers", "1")) == 3
    first = in_process(words(tmp_path, lengths, "there", "--scheduler", dask.address))
    wait_for(tmp_path / "there.partial", 10, first)
    first.send_signal(signal.SIGINT)
    error = first.communicate(timeout=60)[1]
    assert first.returncode == 130, error
    assert "the same command goes on from there" in error
    assert "Traceback" not in error
    second = in_process(words(tmp_path, lengths, "there", "--scheduler", dask.address))
    wait_for(tmp_path / "there.partial", 100, second)
    os.kill(dask.workers[0], signal.SIGKILL)
    error = second.communicate(timeout=120)[1]
    assert second.returncode == 3, error
    assert (tmp_path / "here").read_bytes() == (tmp_path / "there").read_bytes()


@needs_distributed
@pytest.mark.slow
def test_a_scheduler_that_goes_away_is_one_sentence(tmp_path: Path) -> None:
    lengths = rows(tmp_path, 400)
    lost = Cluster(tmp_path, 1)
    process = in_process(words(tmp_path, lengths, "out", "--scheduler", lost.address))
    wait_for(tmp_path / "out.partial", 10, process)
    lost.close()
    error = process.communicate(timeout=120)[1]
    assert process.returncode == 4, error
    assert "no answer: the cluster failed" in error
    assert "the same command goes on from here" in error
    assert "Traceback" not in error
    assert main(words(tmp_path, lengths, "out", "--workers", "2")) == 3
    assert [json.loads(line)["row"] for line in (tmp_path / "out").read_bytes().splitlines()] == list(range(1, 401))


@needs_distributed
def test_a_client_that_fails_in_any_way_is_one_sentence(
    tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*_arguments: object, **_options: object) -> None:
        raise AssertionError

    monkeypatch.setattr("distributed.Client", failing)
    assert main(words(tmp_path, rows(tmp_path, 5), "out", "--scheduler", "tcp://127.0.0.1:9")) == 2
    assert capsys.readouterr().err.count("\n") == 1


@needs_distributed
@pytest.mark.parametrize(
    "address",
    [
        "tcp://127.0.0.1:9",
        "nonsense",
        *(pytest.param(a, marks=pytest.mark.slow) for a in ("tcp://", "ftp://127.0.0.1:9")),
    ],
)
def test_a_scheduler_that_is_not_there_is_one_sentence(tmp_path: Path, address: str) -> None:
    """In a process of its own, as every command is: the loop of a client that failed disturbs the next one."""
    script = (
        "import sys; from pkm_exact.sweep import cluster; from pkm_exact.cli.main import main; cluster.SECONDS = 1; "
        "sys.exit(main(sys.argv[1:]))"
    )
    arguments = words(tmp_path, rows(tmp_path, 5), "out", "--scheduler", address)
    done = subprocess.run(
        [sys.executable, "-c", script, *arguments], capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 2
    assert f"--scheduler {address}: cannot be reached within 1 seconds" in done.stderr
    assert done.stderr.count("\n") == 1


def test_without_distributed_it_says_what_to_install(
    tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    assert main(words(tmp_path, rows(tmp_path, 5), "out", "--scheduler", "tcp://127.0.0.1:8786")) == 2
    assert 'pip install "pkm_exact[distributed]"' in capsys.readouterr().err


@needs_distributed
def test_a_region_on_a_cluster_gives_the_same_bytes(tmp_path: Path, dask: Cluster) -> None:
    question = tmp_path / "question.toml"
    lines = "[region]\nposition = [[0, 9], [0, 9]]\ndegrees = 0\n[conditions]\nreachable = true\n[answer]\n"
    question.write_text(f"{lines}kind = 'map'\nsteps = 11\n")
    command = ["region", str(Path(__file__).parent.parent / "models" / "3-rrr.toml"), str(question), "-o"]
    assert main([*command, str(tmp_path / "a.json")]) == 0
    done = in_process([*command, str(tmp_path / "b.json"), "--scheduler", dask.address])
    error = done.communicate(timeout=120)[1]
    assert done.returncode == 0, error
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()
    assert main([*command, str(tmp_path / "c.json"), "--scheduler", dask.address, "--workers", "2"]) == 2
    assert not (tmp_path / "c.json").exists()


class Killed(Exception):  # noqa: N818
    """Dask's word for it."""


def test_of_rows_that_are_sent_together_each_is_tried_alone_before_it_is_given_up() -> None:
    sent: list[list[int]] = []

    class Future:
        def __init__(self, rows: list[LengthRow]) -> None:
            self.rows = rows

        def result(self, timeout: float) -> list[Answer]:
            assert timeout > 0
            if any(row.number == 3 for row in self.rows):
                raise Killed
            return [Answer(row.number, b"") for row in self.rows]

    def submit(_solve: object, _job: object, rows: list[LengthRow], **_options: object) -> Future:
        sent.append([row.number for row in rows])
        return Future(rows)

    def wait(futures: list[Future], **_options: object) -> SimpleNamespace:
        return SimpleNamespace(done=set(futures))

    client: Any = SimpleNamespace(submit=submit, nthreads=lambda: {"worker": 1})
    dask: Any = SimpleNamespace(KilledWorker=Killed, CancelledError=Killed, wait=wait)
    job: Any = None
    workers = ClusterWorkers(dask, client, job)
    assert workers.capacity >= 20
    for number in range(1, 21):
        workers.submit(LengthRow(number, number, ()))
    answers: list[Answer] = []
    while len(answers) < 20:
        answers += workers.finished()
    assert sent == [list(range(1, 11)), list(range(11, 21)), *([number] for number in range(1, 11))]
    assert sorted(answer.number for answer in answers) == list(range(1, 21))
    lines = {answer.number: answer.line for answer in answers}
    assert b"was killed" in lines.pop(3)
    assert set(lines.values()) == {b""}
