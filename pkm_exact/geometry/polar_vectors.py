"""Vectors of a model file by length and angles in degrees, in place of coordinates.

    { length = L, degrees = a, elevation = e, z = h }    L (cos e cos a, cos e sin a, sin e) + (0, 0, h)

in ordinary coordinates, but for h, which is one of the file's. Length 1, elevation 0 and z 0 may be left out; in the
plane there are only length and degrees. Cosine and sine are points of a circle with rational coordinates: exact where
the angle has such, otherwise those of a half tangent next to it (``angle_degrees``), and then a stand-in is noted.
"""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Final

from pkm_exact.constraints.form import Vector
from pkm_exact.errors import InputError
from pkm_exact.geometry.angle_degrees import StandIn, angle_in_degrees
from pkm_exact.geometry.chains import CosSin
from pkm_exact.geometry.fields import known_keys, required, truth
from pkm_exact.geometry.inverse import UNIT_METRIC, Metric, dot
from pkm_exact.geometry.rational import WrittenVector, parse_positive, parse_rational, rational_root
from pkm_exact.wording import shown

_PLANE: Final = ("degrees", "length", "exact")
_SPACE: Final = ("degrees", "elevation", "length", "z", "exact")
_NOT_GEOMETRY: Final = ("configurations", "nominal")
"""Tables with angles that are no vectors."""
_NO_VECTOR: Final = frozenset({"name", "kind", "position"})
"""Keys of tables with angles that are bodies or poses."""
_DEPTH: Final = 5
"""How deep the vectors of a model file can stand."""


class PolarVector(WrittenVector):
    """A vector by its length and angles.

    Attributes
    ----------
    table : mapping
        As in the file.
    where : str
        Its place.
    metric : tuple of 3 int
        Of the coordinates that it is to have.
    exact : bool
        Whether angles without exact cosine and sine are refused, whatever the table says.
    stand_ins : dict
        What stood in for its angles so far, by their places.

    Examples
    --------
    >>> found = PolarVector({"length": 2, "degrees": 60}, "slides.direction", (1, 3, 1))
    >>> [str(x) for x in found.numbers(2)], found.stand_ins
    (['1', '1'], {})
    """

    def __init__(
        self, table: Mapping[str, Any], where: str, metric: Metric = UNIT_METRIC, *, exact: bool = False
    ) -> None:
        self.table, self.where, self.metric, self.exact = table, where, metric, exact
        self.stand_ins: dict[str, StandIn] = {}

    def numbers(self, dimension: int) -> list[Fraction]:
        """Its coordinates in the metric."""
        root = rational_root(Fraction(self.metric[0]))
        if root is None:
            raise InputError(
                f"{self.where}: in a metric whose first number is no square no such vector is rational; give "
                "coordinates"
            )
        known_keys(dict(self.table), _PLANE if dimension == 2 else _SPACE, self.where)
        c, s = self._point("degrees", self.metric[1])
        x, y = self._length() * c / root, self._length() * s
        if dimension == 2:
            return [x, y]
        over, up = self._point("elevation", self.metric[2])
        return [over * x, over * y, self._length() * up + self._number("z")]

    def in_ordinary_coordinates(self) -> PolarVector:
        """The same for coordinates that the metric of the file does not touch."""
        found = PolarVector(self.table, self.where, exact=self.exact)
        found.stand_ins = self.stand_ins
        return found

    def product(self, first: Vector, second: Vector, metric: Metric) -> Fraction:
        """The product of two vectors that enclose the angle, if their lengths have a rational product."""
        known_keys(dict(self.table), ("degrees", "exact"), self.where)
        root = rational_root(dot(first, first, metric) * dot(second, second, metric))
        if root is None:
            raise InputError(
                f"{self.where}: the lengths of the two directions have no rational product; give directions of "
                "rational length"
            )
        degrees = parse_rational(required(dict(self.table), "degrees", f"{self.where}."), f"{self.where}.degrees")
        cosine, _ = self._point("degrees", 3 if degrees % 60 == 0 and degrees % 180 else 1)
        return root * cosine

    def _point(self, key: str, weight: int) -> CosSin:
        if key not in self.table:
            return Fraction(1), Fraction(0)
        exact = truth(dict(self.table), "exact", self.where)
        where = f"{self.where}.{key}"
        point, stand_in = angle_in_degrees(self.table[key], where, weight, exact=exact)
        if stand_in is not None and self.exact:
            raise InputError(
                f"{where}: cosine and sine of {shown(self.table[key])} degrees are not both rational, as this "
                "kind needs them; give the vector by its coordinates"
            )
        if stand_in is not None:
            self.stand_ins[where] = stand_in
        return point

    def _length(self) -> Fraction:
        return parse_positive(self.table.get("length", 1), f"{self.where}.length")

    def _number(self, key: str) -> Fraction:
        return parse_rational(self.table.get(key, 0), f"{self.where}.{key}")


def with_polar_vectors(
    table: dict[str, Any], metric: Metric, *, exact: bool = False
) -> tuple[dict[str, Any], list[PolarVector]]:
    """The tables of a model file with vectors by length and angles as such, and these.

    Examples
    --------
    >>> table, found = with_polar_vectors({"slides": {"directions": [{"degrees": 30}, [1, 0]]}}, (1, 1, 1))
    >>> [vector.where for vector in found], table["slides"]["directions"][1]
    (['slides.directions[1]'], [1, 0])
    """
    found: list[PolarVector] = []

    def walked(value: Any, where: str, depth: int) -> Any:
        if isinstance(value, dict) and value.keys() & {"degrees", "elevation"} and not value.keys() & _NO_VECTOR:
            found.append(PolarVector(value, where, metric, exact=exact))
            return found[-1]
        if depth == _DEPTH:
            return value
        if isinstance(value, dict):
            return {
                key: entry
                if not depth and key in _NOT_GEOMETRY
                else walked(entry, f"{where}.{key}" if where else key, depth + 1)
                for key, entry in value.items()
            }
        if isinstance(value, list):
            return [walked(entry, f"{where}[{i}]", depth + 1) for i, entry in enumerate(value, 1)]
        return value

    return walked(table, "", 0), found
