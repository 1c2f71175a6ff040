"""Models to begin with: a robot of any kind from a few numbers, as a commented model file."""

from typing import Final

MOST_DECIMALS: Final = 12
"""To which joints can be rounded."""
