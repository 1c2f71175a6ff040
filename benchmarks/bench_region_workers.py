"""One worker against several on a question about a region in all six coordinates: wall time and processor time.

    python benchmarks/bench_region_workers.py [WORKERS] [DEGREES] [PRECISION]

The largest cube of positions of Rolland's hexapod about (0, 0, 660), all three angles within so many degrees, to a
relative precision. To be run on an idle machine: whatever else runs is in the wall time, so that the load is printed.
What a loaded machine can say is computed by ``region_schedule.py``.
"""

from __future__ import annotations

import ctypes
import os
import resource
import subprocess
import sys
import tempfile
import time
from hashlib import sha256
from pathlib import Path
from statistics import median

PR_SET_CHILD_SUBREAPER = 36
MODEL = Path(__file__).parent.parent / "models" / "rolland-6-6.toml"
RUNS = 3
QUESTION = """[region]
rpy_degrees = [[-{0}, {0}], [-{0}, {0}], [-{0}, {0}]]
[conditions]
no_type_2 = true
[answer]
kind = "largest"
shape = "cube"
about = [0, 0, 660]
precision = "{1}"
steps = 60
"""


def adopt() -> None:
    """Become the parent of processes whose parent has ended (Linux): their processor time counts too."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def wait_for_all() -> None:
    """Wait until no process that was begun here is left."""
    try:
        while True:
            os.wait()
    except ChildProcessError:
        return


def timed(question: Path, workers: int) -> tuple[float, float, str]:
    """Wall time, processor time, and a digest of what is printed."""
    command = [str(Path(sys.executable).parent / "certify-poses"), "region", str(MODEL), str(question)]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([*command, "--workers", str(workers), "--format", "json"], check=True, stdout=subprocess.PIPE)
    wall = time.monotonic() - start
    wait_for_all()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, used, sha256(done.stdout).hexdigest()[:16]


def main() -> None:
    """Time one worker and several, in turn, and again."""
    given = sys.argv[1:4]
    workers, degrees, precision = (*given, *("2", "10", "1/1000")[len(given) :])
    counts = (1, int(workers))
    adopt()
    print(f"cores: {os.cpu_count()}, load before: {os.getloadavg()[0]:.2f}")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        question = Path(folder) / "question.toml"
        question.write_text(QUESTION.format(degrees, precision))
        for number in range(RUNS):
            rows.append([timed(question, count) for count in counts])
            said = "; ".join(
                f"{count}: {row[0]:.1f} s, {row[1]:.1f} s of processors"
                for count, row in zip(counts, rows[-1], strict=True)
            )
            print(f"run {number + 1}: {said}; load {os.getloadavg()[0]:.2f}", flush=True)
    for count, of_count in zip(counts, zip(*rows, strict=True), strict=True):
        wall, used = (median(row[k] for row in of_count) for k in (0, 1))
        print(f"{count} workers, medians: {wall:.1f} s, processor time {used:.1f} s, answer {of_count[0][2]}")
    shares = [several[0] / one[0] for one, several in rows]
    print(f"share of the time: {median(shares):.2f} (of {RUNS}: {min(shares):.2f} to {max(shares):.2f})")
    print(f"the same bytes: {len({row[2] for pair in rows for row in pair}) == 1}")


if __name__ == "__main__":
    main()
