"""Coverage-guided fuzzing with atheris: ``python fuzz/fuzz.py TARGET [--seconds N] [--corpus FOLDER]``.

What is found is written beside the corpus folder as crash-.., timeout-.. or oom-..; it is repeated by
``python fuzz/targets.py TARGET FILE``. Every run is bounded in time and memory.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["pkm_exact"]):
    from mutation import mutated
    from seeds import seeds
    from targets import ROOT, TARGETS

LONGEST = 1 << 15


def main() -> None:
    """Seed the corpus and fuzz."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("target", choices=TARGETS)
    parser.add_argument("--seconds", type=int, default=600, help="how long (default 600)")
    parser.add_argument("--corpus", type=Path, help="folder of inputs (default build/fuzz/TARGET/corpus)")
    parser.add_argument("--timeout", type=int, default=60, help="seconds of one input that count as a hang")
    arguments = parser.parse_args()
    corpus = arguments.corpus or ROOT / "build" / "fuzz" / arguments.target / "corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    for number, seed in enumerate(seeds(arguments.target)):
        (corpus / f"seed-{number}").write_bytes(seed)
    words = [sys.argv[0], str(corpus), f"-max_total_time={arguments.seconds}", f"-timeout={arguments.timeout}"]
    words += [f"-artifact_prefix={corpus.parent}/", "-rss_limit_mb=2048", f"-max_len={LONGEST}", "-print_final_stats=1"]
    is_structured = arguments.target in ("certificate", "checkers")
    atheris.Setup(words, TARGETS[arguments.target], custom_mutator=_mutate if is_structured else None)
    atheris.Fuzz()


def _mutate(data: bytes, longest: int, seed: int) -> bytes:
    """Mostly a change of the document, sometimes of its bytes."""
    changed = mutated(data, seed) if seed % 5 else None
    if changed is None or len(changed) > longest:
        return bytes(atheris.Mutate(data, longest))
    return changed


if __name__ == "__main__":
    main()
