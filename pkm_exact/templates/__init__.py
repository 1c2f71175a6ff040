"""Models to begin with: a robot of any kind from a few numbers, as a commented model file."""

from typing import Final

MOST_DECIMALS: Final = 12
"""To which joints can be rounded."""
DEFAULT_DECIMALS: Final = 6
"""To which they are, where no ordinary coordinates are exact."""
