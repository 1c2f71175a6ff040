"""Mechanisms in model files: what a table means, and what is wrong with one that means nothing."""

import re
from fractions import Fraction

import pytest

from pkm_exact.constraints.constraint_types import CONSTRAINTS
from pkm_exact.errors import InputError
from pkm_exact.geometry.mechanism import LockedValues, Mechanism
from pkm_exact.geometry.mechanism_reader import value_keys
from pkm_exact.geometry.reader import robot_from_toml
from pkm_exact.motions.motion_groups import MOTIONS

HEAD = 'schema = 1\nname = "it"\nkind = "constraints"\nunit = "m"\nsource = "made up for a test"\n'
ROD = '[[constraints]]\nname = "rod"\ntype = "distance"\nbase = [1, 2, 3]\nplatform = [0, "1/2", 0]\n'
FREE = HEAD + ROD + "actuated = true\n"
EVERY_FIELD = {
    "base": [1, 2, 3],
    "platform": [4, 5, 6],
    "point": [1, 0, "1/3"],
    "direction": [1, 1, 2],
    "normal": [0, 1, 2],
    "length": "3/2",
    "length_squared": "9/4",
    "radius": "1/2",
    "radius_squared": "1/4",
    "offset": -2,
    "product": "1/2",
    "coefficients": [1, *[0] * 15, -1],
}


def mechanism(text: str) -> Mechanism:
    found = robot_from_toml(text)
    assert isinstance(found, Mechanism)
    return found


def toml(value: object) -> str:
    return f'"{value}"' if isinstance(value, str) else str(value).replace("'", '"')


@pytest.mark.parametrize("type_", CONSTRAINTS)
def test_every_type_can_be_written_in_a_file(type_: str) -> None:
    found = CONSTRAINTS[type_]
    for value in value_keys(found) or (None,):
        fields = [field for field in found.fields if field != found.value_field] + ([value] if value else [])
        rows = "".join(f"{field} = {toml(EVERY_FIELD[field])}\n" for field in fields)
        (constraint,) = mechanism(f'{HEAD}[[constraints]]\nname = "c"\ntype = "{type_}"\n{rows}').constraints
        assert type(constraint) is found
        assert constraint.name == "c"
        if found.value_field is not None:
            assert getattr(constraint, found.value_field) == Fraction(EVERY_FIELD[found.value_field])


@pytest.mark.parametrize("name", MOTIONS)
def test_every_motion_can_be_named(name: str) -> None:
    rod = ROD.replace("[1, 2, 3]", "[1, 2]").replace('[0, "1/2", 0]', "[0, 1]") if name == "planar" else ROD
    assert mechanism(HEAD + f'motion = "{name}"\n' + rod + "length = 1\n").motion is MOTIONS[name]


def test_constants_make_one_configuration() -> None:
    found = mechanism(HEAD + ROD + 'length = "1.5"\n')
    assert found.configurations == (LockedValues("home", ()),)
    assert found.problem(found.configuration()).distances[0].length_squared == Fraction(9, 4)


def test_actuated_values_come_from_configurations() -> None:
    found = mechanism(
        FREE
        + '[[configurations]]\nname = "a"\nvalues = { rod = "3/2" }\n'
        + '[[configurations]]\nname = "b"\nvalues_squared = { rod = 2 }\n'
        + '[[configurations]]\nname = "c"\npose = { position = [1, 1, 1], quaternion = [1, 0, 0, 0] }\n'
    )
    squares = [found.problem(configuration).distances[0].length_squared for configuration in found.configurations]
    assert squares == [Fraction(9, 4), 2, Fraction(1, 4) + 4]
    assert found.problem_at([Fraction(3)]).distances[0].length_squared == 9
    assert found.problem_at([Fraction(3)], squared=True).distances[0].length_squared == 3


def test_a_pose_of_a_smaller_motion_leaves_out_what_does_not_move() -> None:
    text = (
        FREE.replace("unit", 'motion = "translation"\nunit')
        + '[[configurations]]\nname = "a"\npose = { position = [1, 1, 1] }\n'
    )
    assert mechanism(text).configuration().values == (Fraction(17, 4),)
    text = FREE.replace("unit", 'motion = "spherical"\nunit')
    text += '[[configurations]]\nname = "a"\npose = { quaternion = [1, 0, 0, 0] }\n'
    assert mechanism(text).configuration().values == (1 + Fraction(9, 4) + 9,)


PLANE = ROD.replace("distance", "in-plane").replace("base =", "normal =")
BAD = [
    (HEAD, "constraints: is missing; add a table [[constraints]]"),
    (HEAD + "constraints = 5\n", "constraints: 5 is not a list of tables; write [[constraints]]"),
    (HEAD + 'motion = "helical"\n' + ROD + "length = 1\n", "motion: 'helical' is unknown; use one of: spatial, planar"),
    (HEAD + ROD.replace("distance", "sphere"), "constraints[1].type: 'sphere' is unknown; use one of: distance"),
    (HEAD + ROD.replace('name = "rod"\n', ""), "constraints[1].name: is missing"),
    (HEAD + ROD, "constraints[1] ('rod'): no value given; give length or length_squared, or actuated = true"),
    (HEAD + ROD + "length = 1\nlength_squared = 1\n", "length and length_squared given; give length or length_squared"),
    (HEAD + ROD + "length = -1\n", "constraints[1] ('rod').length: -1 is not positive"),
    (HEAD + ROD + "length = 0.5e400\n", "is too long; use at most 200 digits"),
    (HEAD + ROD + 'actuated = "yes"\n', "actuated: 'yes' is neither true nor false; write one of them"),
    (
        FREE + "length = 1\n",
        "constraints[1] ('rod').length: is left to the configurations; remove it, or remove actuated",
    ),
    (
        HEAD + ROD + "length = 1\nstiffness = 5\n",
        "constraints[1] ('rod'): unknown key 'stiffness'; the known keys are: name",
    ),
    (HEAD + ROD.replace("[1, 2, 3]", "[1, 2]") + "length = 1\n", "('rod').base: a list of 2; give a list of 3 numbers"),
    (HEAD + PLANE + "length = 1\n", "unknown key 'length'"),
    (
        HEAD + PLANE.replace("[1, 2, 3]", "[0, 0, 0]") + "offset = 1\n",
        "('rod').normal: is 0; give a direction that is not",
    ),
    (
        HEAD + ROD + "length = 1\n" + ROD + "length = 2\n",
        "constraints: the name 'rod' is used twice; rename one of them",
    ),
    (FREE + '[[configurations]]\nname = "a"\n', "configurations[1] ('a').values: rod missing; give a value for every"),
    (FREE + '[[configurations]]\nname = "a"\nvalues = 5\n', "values: 5 is not a table"),
    (
        FREE + '[[configurations]]\nname = "a"\nvalues = { leg = 5 }\n',
        "'leg': is not an actuated constraint; the actuated ones",
    ),
    (
        FREE + '[[configurations]]\nname = "a"\nvalues = { rod = 0 }\n',
        "configurations[1] ('a').values.'rod': 0 is not positive",
    ),
    (
        FREE + '[[configurations]]\nname = "a"\nlengths = [1]\n',
        "unknown key 'lengths'; the known keys are: name, values",
    ),
    (
        FREE + '[[configurations]]\nname = "a"\nvalues = { rod = 1 }\nvalues_squared = { rod = 1 }\n',
        "values_squared.'rod': is in values too; give it once",
    ),
    (
        FREE + '[[configurations]]\nname = "a"\nvalues = { rod = 1 }\npose = { position = [1, 1, 1] }\n',
        "pose and values given; give one of them",
    ),
    (
        FREE.replace("unit", 'motion = "schoenflies"\nunit')
        + '[[configurations]]\nname = "a"\npose = { position = [1, 1, 1], quaternion = [1, 1, 0, 0] }\n',
        "pose: is not among the translations, and turns about the third axis that the mechanism is capable of",
    ),
    (
        HEAD + '[[constraints]]\nname = "c"\ntype = "linear"\ncoefficients = [1, 2]\n',
        "coefficients: 2 numbers; give 17",
    ),
    (
        HEAD + f'[[constraints]]\nname = "c"\ntype = "linear"\ncoefficients = {[0] * 16 + [1]}\n',
        "coefficients: all but the last are 0; give a form that depends on the pose",
    ),
    (
        HEAD
        + '[[constraints]]\nname = "c"\ntype = "at-point"\npoint = [0, 0, 0]\nplatform = [0, 0, 0]\nactuated = true\n',
        "at-point has no value",
    ),
    (HEAD + "[base]\njoints = []\n" + ROD + "length = 1\n", "top level: unknown key 'base'"),
]


@pytest.mark.parametrize(("text", "message"), BAD)
def test_what_means_nothing_is_refused_in_one_sentence(text: str, message: str) -> None:
    with pytest.raises(InputError, match=re.escape(message)) as error:
        robot_from_toml(text)
    assert "\n" not in str(error.value)


def test_a_file_has_at_most_64_constraints() -> None:
    rows = "".join(ROD.replace('"rod"', f'"rod {k}"') + "length = 1\n" for k in range(65))
    with pytest.raises(InputError, match="constraints: 65 given; give 1 to 64"):
        robot_from_toml(HEAD + rows)


@pytest.mark.parametrize("values", [[], [1, 2]])
def test_values_must_be_as_many_as_actuators(values: list[int]) -> None:
    with pytest.raises(InputError, match=f"{len(values)} values; give 1, for rod"):
        mechanism(FREE).problem(values)
