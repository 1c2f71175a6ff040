"""Which kind a model is of. Who only asks need not load what describes the others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pkm_exact.geometry.kind_names import CHAINS_KIND, LINKS_KIND

if TYPE_CHECKING:
    from typing_extensions import TypeIs

    from pkm_exact.geometry.linkage import Linkage
    from pkm_exact.geometry.links import Links


def is_linkage(model: object) -> TypeIs[Linkage]:
    """Whether it is a mechanism of bodies and joints."""
    return getattr(model, "kind", None) == CHAINS_KIND


def is_links(model: object) -> TypeIs[Links]:
    """Whether it is a mechanism with passive bodies."""
    return getattr(model, "kind", None) == LINKS_KIND
