"""Names of the kinds of models that are not robots with legs between joints, and which of them a model is.

Who only asks need not load what describes them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from typing_extensions import TypeIs

    from pkm_exact.geometry.linkage import Linkage
    from pkm_exact.geometry.links import Links

CONSTRAINTS_KIND: Final = "constraints"
"""Of mechanisms that are declared by their constraints."""
LINKS_KIND: Final = "links"
CHAINS_KIND: Final = "chains"


def is_linkage(model: object) -> TypeIs[Linkage]:
    """Whether it is a mechanism of bodies and joints."""
    return getattr(model, "kind", None) == CHAINS_KIND


def is_links(model: object) -> TypeIs[Links]:
    """Whether it is a mechanism with passive bodies."""
    return getattr(model, "kind", None) == LINKS_KIND
