"""What rows of one robot have in common at infinity, where lengths drop out of all conditions."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import gcd
from typing import Any

from pkm_exact.completeness.conditions import Conditions


@dataclass
class SharedBoundary:
    """What is found modulo primes of the points at infinity, for further rows with the same conditions there.

    Attributes
    ----------
    conditions : tuple
        On the boundary; others begin anew.
    bounds : list of int or None
        How many points there are at most, as far as each attempt told.
    sections : dict
        By whether few relations were taken: the sections modulo primes.
    """

    conditions: tuple[object, ...] = ()
    bounds: list[int | None] = field(default_factory=list)
    sections: dict[bool, list[Any]] = field(default_factory=lambda: {True: [], False: []})

    def of(self, conditions: Conditions) -> SharedBoundary:
        """This, if it is what the conditions are at infinity, or else emptied for them."""
        forms = []
        for form in conditions.forms:
            content = gcd(*form[:-1]) or 1
            forms.append(tuple(value // content for value in form[:-1]))
        quadrics = [tuple(sorted(quadric.items())) for quadric in conditions.quadrics]
        key = (tuple(forms), tuple(quadrics), conditions.metric, conditions.motion.name)
        if key != self.conditions:
            self.conditions, self.bounds, self.sections = key, [], {True: [], False: []}
        return self
