"""The option ``--recompute`` of ``check``: one line per certificate, and how many are what."""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from pkm_exact.certify.certificate import content_of
from pkm_exact.cli.model_reading import announced_robot
from pkm_exact.cli.program import ExitCode, worst
from pkm_exact.errors import InputError, InternalError, PkmExactError
from pkm_exact.failures.failure_report import reported
from pkm_exact.files import write_whole
from pkm_exact.interactive.progress import Progress
from pkm_exact.recomputation import Outcome, Recomputation, recompute
from pkm_exact.stages import Prefixed
from pkm_exact.wording import counted, printable

_CODES = {
    Outcome.SAME: ExitCode.DONE,
    Outcome.DIFFERENT: ExitCode.REJECTED,
    Outcome.REJECTED: ExitCode.REJECTED,
    Outcome.MALFORMED: ExitCode.BAD_INPUT,
    Outcome.TOO_LARGE: ExitCode.BAD_INPUT,
}
_UPDATED, _UNUSABLE, _NO_ANSWER = "updated", "unusable", "no answer"


def recompute_all(files: Sequence[Path], models: Path | None, *, update: bool) -> ExitCode:
    """Recompute each certificate and print its line, then the total."""
    counts: Counter[str] = Counter()
    codes = []
    for path in files:
        code, outcome, detail = _outcome(path, models, update=update)
        separator = "," if outcome == Outcome.SAME else ":"
        sys.stdout.write(printable(f"{path}: {outcome}{separator} {detail}") + "\n")
        sys.stdout.flush()
        counts[outcome] += 1
        codes.append(code)
    parts = ", ".join(f"{count} {outcome}" for outcome, count in counts.items())
    sys.stdout.write(f"{counted(len(files), 'certificate')}: {parts}\n")
    return worst(codes)


def _outcome(path: Path, models: Path | None, *, update: bool) -> tuple[ExitCode, str, str]:
    """Exit code, outcome and detail of one file."""
    try:
        found = _recomputed(path, models)
        if update and found.outcome == Outcome.DIFFERENT and found.data is not None:
            _write(path, found.data)
            return ExitCode.DONE, _UPDATED, found.detail
    except InputError as error:
        return ExitCode.BAD_INPUT, _UNUSABLE, printable(str(error)).removeprefix(f"{printable(str(path))}: ")
    except MemoryError:
        return ExitCode.NO_ANSWER, _NO_ANSWER, "the memory is exhausted"
    except Exception as error:
        is_meant = isinstance(error, PkmExactError) and not isinstance(error, InternalError)
        return ExitCode.NO_ANSWER, _NO_ANSWER, str(error) if is_meant else reported(error)
    return _CODES[found.outcome], found.outcome, found.detail


def _recomputed(path: Path, models: Path | None) -> Recomputation:
    data = content_of(path)
    robot = None if models is None else announced_robot(_model_of(path, models), "--recompute")
    name = printable(str(path))
    with Progress(verbose=False) as progress:
        progress(name)
        return recompute(data, robot=robot, progress=Prefixed(progress, f"{name}: "))


def _model_of(path: Path, models: Path) -> Path:
    """NAME.toml for NAME.json and for NAME.anything.json."""
    stem = path.name.removesuffix(".json")
    while True:
        model = models / f"{stem}.toml"
        if model.exists():
            return model
        stem, dot, _ = stem.rpartition(".")
        if not dot:
            name = path.name.removesuffix(".json")
            raise InputError(f"{path}: there is no {models / name}.toml; add the model, or remove the certificate")


def _write(path: Path, data: bytes) -> None:
    try:
        write_whole(path, data)
    except OSError as error:
        raise InputError(f"{path}: cannot be written ({error.strerror}); make it writable") from None
