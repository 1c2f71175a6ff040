"""What is installed here: the versions that an answer can depend on, and the optional extras."""

from __future__ import annotations

import platform
import re
from collections.abc import Iterator
from importlib import metadata
from typing import Final

import pkm_exact

DISTRIBUTION: Final = "pkm_exact"
_REQUIRED: Final = ("numpy", "mpmath", "sympy", "click", "rich")
_FOR_DEVELOPERS: Final = ("test", "docs", "notebooks", "benchmarks", "fuzz")
_REQUIREMENT: Final = re.compile(r"""\s*([A-Za-z0-9][A-Za-z0-9._-]*).*;.*\bextra\s*==\s*["']([^"']+)["']""")


def version_lines() -> Iterator[str]:
    """The versions, in a few lines; reads metadata, and loads no library but FLINT, which alone knows its own version.

    Examples
    --------
    >>> next(version_lines()) == f"certify-poses {pkm_exact.__version__}"
    True
    """
    yield f"certify-poses {pkm_exact.__version__}"
    yield f"{platform.python_implementation()} {platform.python_version()}, {platform.system()} {platform.machine()}"
    yield f"python-flint {installed_version('python-flint') or 'missing'}, {_flint()}"
    yield ", ".join(f"{name} {installed_version(name) or 'missing'}" for name in _REQUIRED)
    found = [f"{name} {version}" for name, version in extras().items() if version]
    yield f"extras: {', '.join(found) or 'none'}"


def installed_version(name: str) -> str | None:
    """The version of an installed distribution; None if it is not installed.

    >>> installed_version("no-such-distribution") is None
    True
    """
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return None


def extras() -> dict[str, str | None]:
    """The distributions that optional extras bring, and the installed version of each, or None."""
    try:
        requirements = metadata.requires(DISTRIBUTION) or []
    except metadata.PackageNotFoundError:  # run from its sources: nobody wrote down what is optional
        return {}
    found = [match.groups() for text in requirements if (match := _REQUIREMENT.match(text))]
    names = {name for name, extra in found if extra not in _FOR_DEVELOPERS and name != DISTRIBUTION}
    return {name: installed_version(name) for name in sorted(names)}


def _flint() -> str:
    try:
        import flint

        from pkm_exact.certify.build import VERSION
    except ImportError as error:
        return f"which cannot be loaded ({error})"
    return f"FLINT {flint.__FLINT_VERSION__}; certificates of version {VERSION}"
