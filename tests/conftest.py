"""Settings of the whole suite: property tests are deterministic and not timed, so a busy machine cannot fail them."""

import gc
import re
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import settings
from processor_time import ProcessorTime
from slow_tests import MEASURED, is_listed

from pkm_exact.certify import pure
from pkm_exact.cli.main import prefer_one_thread

prefer_one_thread()  # before numpy is loaded, also in processes of tests: the cores have other tests to run
settings.register_profile("suite", deadline=None, derandomize=True)
settings.load_profile("suite")


def pytest_configure(config: pytest.Config) -> None:
    """A shell's background jobs ignore interrupts, and so does all that they start; some tests send them."""
    config.pluginmanager.register(ProcessorTime())
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """What was measured to be slow is marked before marks are asked for."""
    for item in items:
        if is_listed(item.nodeid, MEASURED):
            item.add_marker(pytest.mark.slow)
            item.add_marker(pytest.mark.in_corpus)


def pytest_collection_finish() -> None:
    """Thousands of tests and the libraries that they load stay to the end: no collection of garbage looks at them."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(tryfirst=True)
def pytest_sessionfinish() -> None:
    """What is left over then is looked at once."""
    gc.unfreeze()


@pytest.fixture
def collinear_model(tmp_path: Path) -> Path:
    """A robot whose platform joints lie on one line, about which it can turn."""
    text = (Path(__file__).parent.parent / "models" / "mourrain-l.toml").read_text()
    joints = ", ".join(f"[{k}, 0, 0]" for k in range(6))
    text = text.replace(
        'lengths = [1, 1, "4/5", 2, 2, 2]', "pose = { position = [1, 2, 3], quaternion = [1, 2, 3, 4] }"
    )
    path = tmp_path / "collinear.toml"
    path.write_text(re.sub(r"\[platform\].*?\n]\n", f"[platform]\njoints = [{joints}]\n", text, flags=re.DOTALL))
    return path


@pytest.fixture
def remembered(monkeypatch: pytest.MonkeyPatch) -> None:
    """The plain checker proves each box once: its answer depends on system, box and precision alone."""
    for name in ("has_one_solution", "narrowed"):
        monkeypatch.setattr(pure, name, remembering(getattr(pure, name)))


def remembering(function: Callable[..., Any]) -> Callable[..., Any]:
    known: dict[str, Any] = {}

    def answer(*arguments: Any) -> Any:
        key = repr(arguments)
        if key not in known:
            known[key] = function(*arguments)
        return known[key]

    return answer
