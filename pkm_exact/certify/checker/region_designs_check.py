"""The word of a region certificate about designs: boxes of parameters, each with a word about the region."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from pkm_exact.certify.checker.budget import charge
from pkm_exact.certify.checker.region_coefficients import Part
from pkm_exact.certify.checker.region_document import MOST_STEPS, RegionDocument
from pkm_exact.certify.checker.region_proofs import LETTER, is_proved, ranges_on
from pkm_exact.certify.checker.region_ring import Condition, Conditions, Signed, beyond
from pkm_exact.certify.checker.verdict import malformed, rejected

_GOOD: Final = "y"
_BAD: Final = "n"


def designs_lines(document: RegionDocument, conditions: Conditions) -> Iterator[str]:
    """One line for each claim that is proved."""
    if document.measure is not None:
        raise malformed("measure: claimed where there is none")
    found = _Designs(document, conditions).counts()
    if (found[_GOOD], found["u"]) != (document.inside, document.undecided):
        raise rejected("inside, undecided: not as many boxes of designs as the paving has")
    yield f"paving: {found[_GOOD]} boxes of designs good, {found[_BAD]} not, each proved; {found['u']} undecided"


class _Designs:
    """Follows the word, letter by letter."""

    def __init__(self, document: RegionDocument, conditions: Conditions) -> None:
        self._document, self._conditions, self._place = document, conditions, 0
        self._good: Condition = ("or", [beyond(conditions.region), conditions.asked])
        determinant = conditions.determinant
        reached: list[Condition] = [conditions.region, *(Signed(root, "0+") for root in conditions.roots)]
        self._signs: dict[str, Condition] = {}
        if determinant is not None:
            self._signs = {
                "+": ("and", [*reached, Signed(determinant, "+")]),
                "-": ("and", [*reached, Signed(-determinant, "+")]),
            }

    def counts(self) -> dict[str, int]:
        """How many boxes of designs are good, bad and undecided; refused if one is not proved."""
        document = self._document
        count = len(document.parameters)
        first = len(document.variables) - count
        found = dict.fromkeys((_GOOD, _BAD, "u"), 0)
        waiting = [Part(0)]
        while waiting:
            part, letter = waiting.pop(), self._letter()
            if letter == "s":
                if part.depth >= MOST_STEPS:
                    raise rejected(f"paving: letter {self._place} halves designs more often than {MOST_STEPS} times")
                waiting += part.halves(first + part.depth % count)[::-1]
                continue
            if letter not in found:
                raise rejected(f"paving: letter {self._place} says nothing of designs")
            found[letter] += 1
            if letter != "u":
                self._region(part, letter)
        if self._place != len(document.paving):
            raise rejected("paving: it goes on after its end")
        return found

    def _letter(self) -> str:
        charge(LETTER)
        if self._place == len(self._document.paving):
            raise rejected("paving: parts of the region are missing")
        self._place += 1
        return self._document.paving[self._place - 1]

    def _region(self, designs: Part, verdict: str) -> None:
        """The word of the region for a box of designs."""
        axes, start, seen = self._document.axes, self._place, set()
        waiting = [designs]
        while waiting:
            part, letter = waiting.pop(), self._letter()
            if letter == "s":
                if part.depth - designs.depth >= len(axes):
                    raise rejected(f"paving: letter {self._place} halves a part deeper than the axes say")
                waiting += part.halves(axes[part.depth - designs.depth])[::-1]
                continue
            if letter not in ("i" if verdict == _GOOD else "xo+-"):
                raise rejected(f"paving: letter {self._place} does not belong to what is said of the designs")
            if letter != "x" and not self._is_proved(letter, part):
                raise rejected(f"paving: what letter {self._place} says is not proved")
            seen.add(letter)
        if verdict == _BAD and "o" not in seen and not {"+", "-"} <= seen:
            raise rejected(f"paving: the designs of letter {start} are not refuted")

    def _is_proved(self, letter: str, part: Part) -> bool:
        range_of = ranges_on(part, self._document, self._conditions.roots)
        if letter == "i":
            return is_proved(self._good, range_of, wanted=True)
        if letter == "o":
            inside = is_proved(self._conditions.region, range_of, wanted=True)
            return inside and is_proved(self._conditions.asked, range_of, wanted=False)
        return letter in self._signs and is_proved(self._signs[letter], range_of, wanted=True)
