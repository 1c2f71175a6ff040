"""How far computed doubles are off, at most: constants with room for sums of up to ten products and their data."""

from __future__ import annotations

from typing import Final

U: Final = 2.0**-53
"""The unit roundoff."""

OUTWARD: Final = 1 + 2.0**-40
"""For the roundings of bounds themselves, of which there are far less than 2^12 in a row."""

TINY: Final = 1e-290
"""For what may have been lost below the smallest normal double."""

FORM_ERROR: Final = 40 * U
"""Of the value of a quadratic form at a point: an entry (13 roundings), and two sums of at most eight products."""

SLOPE_ERROR: Final = 48 * U
"""Of an entry of Y F': an entry of F' (23 roundings), and a sum of at most eight products."""

ENDS_ERROR: Final = 8 * U
"""Of a coordinate of a leg's lower end: data, sine or cosine (two units), product and sums."""
