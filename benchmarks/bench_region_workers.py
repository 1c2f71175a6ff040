"""One worker against several on a question about a region in all six coordinates: wall time and processor time.

    python benchmarks/bench_region_workers.py [WORKERS] [EDGE]

A cube of positions of Rolland's hexapod about (0, 0, 660) of so many mm, all three angles within 4 degrees. To be run
on an idle machine: whatever else runs is in the wall time.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from hashlib import sha256
from pathlib import Path

MODEL = Path(__file__).parent.parent / "models" / "rolland-6-6.toml"
QUESTION = """[region]
position = [[-{0}, {0}], [-{0}, {0}], [{1}, {2}]]
rpy_degrees = [[-4, 4], [-4, 4], [-4, 4]]
[conditions]
no_type_2 = true
[answer]
kind = "all"
steps = 40
"""


def timed(question: Path, workers: int, output: Path) -> tuple[float, float, str]:
    """Wall time, processor time, and a digest of the certificate."""
    command = [str(Path(sys.executable).parent / "certify-poses"), "region", str(MODEL), str(question)]
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run([*command, "--workers", str(workers), "-o", str(output)], check=False, stdout=subprocess.DEVNULL)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall, used, sha256(output.read_bytes()).hexdigest()[:16]


def main() -> None:
    """Time one worker, then several."""
    workers, edge = (int(text) for text in (*sys.argv[1:3], *("2", "1850")[len(sys.argv) - 1 :]))
    with tempfile.TemporaryDirectory() as folder:
        question = Path(folder) / "question.toml"
        question.write_text(QUESTION.format(edge / 2, 660 - edge / 2, 660 + edge / 2))
        rows = [timed(question, count, Path(folder) / f"{count}.json") for count in (1, workers)]
    for count, (wall, used, digest) in zip((1, workers), rows, strict=True):
        print(f"{count} workers: {wall:.1f} s, processor time {used:.1f} s, certificate {digest}")
    print(f"share of the time: {rows[1][0] / rows[0][0]:.2f}; the same bytes: {rows[0][2] == rows[1][2]}")


if __name__ == "__main__":
    main()
