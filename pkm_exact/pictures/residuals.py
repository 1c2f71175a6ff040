"""Residuals of each leg at each measured pose, before and after a calibration."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from pkm_exact.pictures import style

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def residuals_figure(before: Sequence[Sequence[float]], after: Sequence[Sequence[float]], unit: str) -> Figure:
    """A panel for each leg: its residuals by the number of the pose.

    Raises
    ------
    InputError
        If matplotlib is not installed.
    """
    with style.plain_style():
        from matplotlib.figure import Figure

        figure = Figure(figsize=(7, 1.3 * len(before) + 0.8), layout="constrained")
        panels = figure.subplots(len(before), 1, sharex=True, squeeze=False)[:, 0]
        for leg, (panel, old, new) in enumerate(zip(panels, before, after, strict=True), 1):
            numbers = range(1, len(old) + 1)
            panel.axhline(0, color="0.7", linewidth=0.8)
            panel.plot(numbers, old, "o", color="0.6", markersize=3, label="model")
            panel.plot(numbers, new, "o", color="C0", markersize=3, label="calibrated")
            panel.set_ylabel(f"leg {leg} [{style.drawable(unit, 12)}]")
        panels[0].legend(loc="upper right", frameon=False, ncols=2)
        panels[-1].set_xlabel("pose")
    return figure
