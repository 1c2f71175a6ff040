"""Names of the kinds of models that are not robots with legs between joints."""

from __future__ import annotations

from typing import Final

CONSTRAINTS_KIND: Final = "constraints"
"""Of mechanisms that are declared by their constraints."""
LINKS_KIND: Final = "links"
CHAINS_KIND: Final = "chains"
