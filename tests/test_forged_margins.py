"""Both checkers keep to the margins of what they compute."""

from fractions import Fraction

import pytest
from certificate_tools import both_resealed, last_line
from forged_at_infinity import AT_INFINITY
from forged_clusters import CLUSTERS
from forged_cylinder_boxes import WIDE, in_a_wide_box
from forged_grids import GRIDS
from forged_margins import MARGINS, huge
from forged_ranks import RANKS
from forged_sections import SECTIONS
from forged_tolerances import TIGHT

from pkm_exact.certify import pure
from pkm_exact.certify.build import canonical_bytes, sealed


@pytest.mark.parametrize("name", [*MARGINS, *SECTIONS, *TIGHT, *AT_INFINITY, *GRIDS, *RANKS, *WIDE, *CLUSTERS])
def test_a_margin(name: str) -> None:
    make, status = (MARGINS | SECTIONS | TIGHT | AT_INFINITY | GRIDS | RANKS | WIDE | CLUSTERS)[name]
    answer = both_resealed(make())
    assert answer.status == status, last_line(answer)


def test_the_plain_checker_writes_no_longer_numbers_than_python_does() -> None:
    answer = pure.check_bytes(canonical_bytes(sealed(huge())))
    assert answer.status == "too-large"
    assert answer.lines[-1].startswith("boxes: a coordinate of more than")


def test_the_plain_checker_proves_as_wide_boxes_on_cylinders_as_its_bounds_admit() -> None:
    content = in_a_wide_box(Fraction(6_634_496, 1 << 20), (6, 6))
    assert pure.check_bytes(canonical_bytes(sealed(content))).status == "accepted"
