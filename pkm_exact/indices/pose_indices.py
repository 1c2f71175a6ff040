"""The indices shown at every pose. One row adds one to all outputs; the tests ask every row."""

from __future__ import annotations

from typing import Final

from pkm_exact.indices.determinant_sign import DETERMINANT_SIGN
from pkm_exact.indices.index import Index, Output
from pkm_exact.indices.jacobian_condition import JACOBIAN_CONDITION
from pkm_exact.indices.jacobian_rank import JACOBIAN_RANK
from pkm_exact.indices.least_singular_value import LEAST_SINGULAR_VALUE

INDICES: Final[list[Index]] = [DETERMINANT_SIGN, JACOBIAN_RANK, LEAST_SINGULAR_VALUE, JACOBIAN_CONDITION]
"""In the order of outputs."""


def shown_in(output: Output) -> list[Index]:
    """The indices of an output, in their order.

    Examples
    --------
    >>> [index.name for index in shown_in(Output.TABLE)]
    ['det_sign', 'condition']
    """
    return [index for index in INDICES if output in index.outputs]
