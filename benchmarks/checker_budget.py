"""How long an operation takes of those that the checkers' budgets count: processor time per operation, file by file.

    python benchmarks/checker_budget.py                          the certificates in certs/
    python benchmarks/checker_budget.py build/checker-mutants/corpus.zip FILE.json

The budgets are counted, so that verdicts do not depend on the machine; one operation stands for about a nanosecond of
the first checker's time, about ten of the plain one's. The last line says how long a file may keep a checker busy that
costs the whole budget at the greatest rate that was seen.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from time import process_time
from typing import Any, NamedTuple
from zipfile import ZipFile

CERTS = Path(__file__).parent.parent / "certs"
LEAST = 10**8
"""Files that cost fewer operations take their time for other things: reading, starting."""


class Rate(NamedTuple):
    """What was measured on one file."""

    name: str
    size: int
    spent: int
    allowed: int
    seconds: float

    @property
    def nanoseconds(self) -> float:
        """For an operation."""
        return 1e9 * self.seconds / self.spent

    @property
    def longest(self) -> float:
        """Seconds that the whole budget of this file would take at this rate."""
        return self.allowed * self.nanoseconds / 1e9

    def __str__(self) -> str:
        numbers = f"{self.size / 1000:>9.0f} kB {self.spent / 1e9:>8.2f} e9 {self.seconds:>8.2f} s"
        return f"{numbers} {self.nanoseconds:>7.2f} ns {self.longest:>7.0f} s  {self.name[:80]}"


HEADING = f"{'size':>12} {'operations':>11} {'time':>10} {'each':>10} {'all':>9}"


def contents(paths: Sequence[Path]) -> Iterator[tuple[str, bytes]]:
    """The files, and those in ZIP archives."""
    for path in paths:
        if path.suffix == ".zip":
            with ZipFile(path) as archive:
                for name in archive.namelist():
                    yield name, archive.read(name)
        else:
            yield path.name, path.read_bytes()


def rate(checker: Any, name: str, data: bytes) -> Rate:
    """Check a file."""
    start = process_time()
    _, budget = checker.check_counted(data)
    seconds = process_time() - start
    return Rate(name, len(data), budget.spent, getattr(budget, "limit", None) or budget.allowed, seconds)


def main() -> int:
    """Print the files at the greatest rates."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("files", nargs="*", type=Path, help="certificates, or ZIP archives of some")
    parser.add_argument("--plain", action="store_true", help="ask the plain checker")
    parser.add_argument("--most", type=int, default=15, help="print as many (default: %(default)s)")
    options = parser.parse_args()
    if options.plain:
        from pkm_exact.certify import pure as checker
    else:
        from pkm_exact.certify import check as checker  # type: ignore[no-redef]
    rates = [rate(checker, *file) for file in contents(options.files or sorted(CERTS.glob("*.json")))]
    counted = sorted((r for r in rates if r.spent >= LEAST), key=lambda r: -r.nanoseconds)
    print(HEADING)
    for entry in counted[: options.most]:
        print(entry)
    total = sum(r.seconds for r in rates)
    print(f"{len(rates)} files, {total:.1f} s, {sum(r.spent for r in rates) / 1e9:.1f} e9 operations")
    if counted:
        print(f"at most {max(r.longest for r in counted):.0f} s for a file, at the rates of these {len(counted)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
