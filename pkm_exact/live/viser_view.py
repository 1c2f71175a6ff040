"""The live view in a browser, by viser: sliders, what is said, and what is drawn. viser is imported here only."""

from __future__ import annotations

import re
from contextlib import redirect_stdout
from dataclasses import replace
from importlib import import_module
from io import StringIO
from threading import Lock
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from pkm_exact.errors import InputError, PkmExactError
from pkm_exact.live.live_answer import LiveAnswer, first_answer, next_answer
from pkm_exact.live.sliders import sliders
from pkm_exact.live.stage_items import Lines, Surface, legend, stage_items
from pkm_exact.precision import working_precision
from pkm_exact.wording import printable

if TYPE_CHECKING:
    from pkm_exact.geometry.mechanism import Mechanism
    from pkm_exact.geometry.robot import Robot

HOST: Final = "127.0.0.1"
"""Of this machine only."""
_MARKUP: Final = re.compile(r"([\\`*_{}\[\]<>#|!&~$])")


def require_viser() -> Any:
    """The package viser.

    Raises
    ------
    InputError
        If it is not installed.
    """
    try:
        return import_module("viser")
    except ImportError:
        raise InputError(
            'view: viser is not installed; install it, for instance with pip install "pkm_exact[view]", or draw a '
            "certificate with certify-poses report"
        ) from None


class LiveView:
    """A robot in the browser, until it is stopped.

    Parameters
    ----------
    robot : Robot or Mechanism
    configuration : str or None
        Where the sliders stand at first.
    port : int
        On which the page is served, to this machine only; or the next one that is free.

    Raises
    ------
    InputError
        If viser is not installed, or no port is free.
    """

    def __init__(self, robot: Robot | Mechanism, configuration: str | None, port: int) -> None:
        viser = require_viser()
        self._robot = robot
        self._lock = Lock()
        self._answer = first_answer(robot, configuration)
        self._sliders = sliders(robot, configuration)
        self._server = _served(viser, port)
        base = np.array(self._answer.scene.base)
        self._middle, self._unit = base.mean(axis=0), self._answer.scene.size
        self._build()

    @property
    def address(self) -> str:
        """Of the page."""
        return f"http://{HOST}:{self._server.get_port()}"

    @property
    def answer(self) -> LiveAnswer:
        """What is shown."""
        return self._answer

    def serve(self) -> None:
        """Wait; Ctrl-C ends it."""
        self._server.sleep_forever()

    def stop(self) -> None:
        """End it."""
        with redirect_stdout(StringIO()):  # it says goodbye
            self._server.stop()

    def _build(self) -> None:
        server, scene = self._server, self._answer.scene
        server.scene.set_up_direction("+y" if scene.motion.is_planar else "+z")
        server.gui.configure_theme(show_logo=False, show_share_button=False)
        server.gui.add_markdown(f"**{as_text(self._robot.name)}** ({as_text(self._robot.kind)})")
        self._handles = [
            server.gui.add_slider(as_label(one.name), one.low, one.high, one.step, one.value) for one in self._sliders
        ]
        self._text = server.gui.add_markdown("")
        server.gui.add_markdown("  \n".join(map(as_text, legend(with_limits=self._robot.limits is not None))))
        for handle in self._handles:
            handle.on_update(lambda _: self.update())
        self._shown: tuple[float, ...] = self._values()
        self._drawn: list[Any] = []
        self._draw()
        server.initial_camera.look_at = (0.0, 0.0, 0.0)
        server.initial_camera.position = (0.0, 0.0, 2.5) if scene.motion.is_planar else (1.2, -1.8, 0.9)

    def _values(self) -> tuple[float, ...]:
        return tuple(float(handle.value) for handle in self._handles)

    def update(self) -> None:
        """Show what is proved where the sliders stand now; one at a time, and nothing if that is shown already."""
        with self._lock:
            values = self._values()
            if values == self._shown:
                return
            self._shown = values
            words = [one.word(value) for one, value in zip(self._sliders, values, strict=True)]
            try:
                with working_precision():
                    self._answer = next_answer(self._robot, words, self._answer)
            except PkmExactError as error:
                self._text.content = f"No answer: {as_text(printable(str(error)))}. Shown are the poses before."
                return
            self._draw()

    def _draw(self) -> None:
        for handle in self._drawn:
            handle.remove()
        self._text.content = "\n\n".join(map(as_text, self._answer.lines()))
        with self._server.atomic():
            self._drawn = [self._added(item) for item in stage_items(self._answer)]

    def _added(self, item: Surface | Lines) -> Any:
        """On a stage whose origin is amid the base and whose unit is the robot's size, as cameras like it."""
        stage, name = self._server.scene, f"/{item.name}"
        if isinstance(item, Lines):
            segments = (item.segments - self._middle) / self._unit
            return stage.add_line_segments(name, segments, item.colour, thickness=item.width / self._unit)
        vertices = (item.vertices - self._middle) / self._unit
        opacity = item.opacity if item.opacity < 1 else None
        surface = stage.add_mesh_simple(
            name, vertices, item.triangles, color=item.colour, opacity=opacity, side="double", flat_shading=True
        )
        if item.place is not None:
            surface.on_click(lambda _, place=item.place: self.choose(place))
        return surface

    def choose(self, place: int) -> None:
        """Make a pose the solid one, by its place in the list."""
        with self._lock:
            if place != self._answer.place and place < len(self._answer.solution.poses):
                self._answer = replace(self._answer, place=place, why="chosen here")
                self._draw()


def _served(viser: Any, port: int) -> Any:
    with redirect_stdout(StringIO()):  # it greets
        try:
            return viser.ViserServer(host=HOST, port=port, label="pkm_exact", verbose=False)
        except (OSError, RuntimeError) as error:
            raise InputError(f"--port {port}: cannot be used ({printable(str(error))}); give another one") from None


def as_text(words: str) -> str:
    r"""Text that markdown shows as it is.

    >>> as_text("a <b> *c*")
    'a \\<b\\> \\*c\\*'
    """
    return _MARKUP.sub(r"\\\1", printable(words))


def as_label(words: str) -> str:
    """A label, on one line and not too long."""
    found = printable(words)
    return found if len(found) <= 40 else f"{found[:37]}..."
