"""Certified poses as arrays of doubles, for numpy, scipy and pandas: midpoints, and half-widths that cover the boxes.

Doubles are for what comes after the proof. Each half-width includes the rounding of its midpoint, so that the exact
value provably lies within it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from importlib import import_module
from math import nan
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from pkm_exact.errors import PkmExactError
from pkm_exact.indices.index import Index, Output
from pkm_exact.indices.pose_indices import shown_in
from pkm_exact.poses.pose import Pose
from pkm_exact.roots.interval import Interval

if TYPE_CHECKING:
    from pandas import DataFrame
    from scipy.spatial.transform import Rotation

UNKNOWN_MULTIPLICITY: Final = 0
"""In place of a multiplicity that is not proved, in arrays, which have no room for None."""
_NAMES: Final = ("x", "y", "z", "qw", "qx", "qy", "qz")


@dataclass(frozen=True, eq=False)
class PoseArrays:
    """Poses in doubles. The arrays of one pose have no first axis (n,).

    Attributes
    ----------
    position : (n, 3) array
        In the robot's unit of length.
    rotation : (n, 3, 3) array
    quaternion : (n, 4) array
        Scalar first; scipy wants it last, and ``to_scipy`` puts it there.
    position_half_width, rotation_half_width, quaternion_half_width : arrays
        Of the same shapes: the exact value lies within it of the midpoint.
    multiplicity : (n,) array of int
        0 where it is not proved.
    indices : mapping of str to (n,) array
        Of every index that is shown at poses: integers, or midpoints of enclosures with nan where nothing is certified.
    """

    position: NDArray[np.float64]
    rotation: NDArray[np.float64]
    quaternion: NDArray[np.float64]
    position_half_width: NDArray[np.float64]
    rotation_half_width: NDArray[np.float64]
    quaternion_half_width: NDArray[np.float64]
    multiplicity: NDArray[np.int64]
    indices: Mapping[str, NDArray[Any]]

    @property
    def det_sign(self) -> NDArray[np.int64]:
        """Sign of the determinant of the leg Jacobian (n,): 0 at a singular pose, 2 where it is not certified."""
        return self.indices["det_sign"]

    @property
    def condition(self) -> NDArray[np.float64]:
        """Condition number of the leg Jacobian (n,): infinite at a singular pose, nan where it is not certified."""
        return self.indices["condition"]

    @property
    def transform(self) -> NDArray[np.float64]:
        """Homogeneous matrices (n, 4, 4), rotation and position: p = T (B, 1) for a platform point B."""
        matrices = np.zeros((*self.position.shape[:-1], 4, 4))
        matrices[..., :3, :3] = self.rotation
        matrices[..., :3, 3] = self.position
        matrices[..., 3, 3] = 1
        return matrices

    @property
    def half_width(self) -> NDArray[np.float64]:
        """The greatest half-width of each pose, over all its coordinates."""
        flat = self.rotation_half_width.reshape((*self.position.shape[:-1], 9))
        widths = np.concatenate([self.position_half_width, flat, self.quaternion_half_width], axis=-1)
        greatest: NDArray[np.float64] = widths.max(axis=-1)
        return greatest

    def __repr__(self) -> str:
        shape = self.position.shape[:-1]
        return f"<PoseArrays: {shape[0]} poses>" if shape else "<PoseArrays: one pose>"


def arrays_of(poses: Sequence[Pose]) -> PoseArrays:
    """The arrays of poses, in their order."""
    position, position_half_width = _balls([pose.position for pose in poses], (3,))
    entries = [[entry for row in pose.rotation for entry in row] for pose in poses]
    rotation, rotation_half_width = _balls(entries, (3, 3))
    quaternion, quaternion_half_width = _balls([pose.quaternion for pose in poses], (4,))
    return PoseArrays(
        position,
        rotation,
        quaternion,
        position_half_width,
        rotation_half_width,
        quaternion_half_width,
        np.array([pose.multiplicity or UNKNOWN_MULTIPLICITY for pose in poses], dtype=np.int64),
        {index.name: _values(index, poses) for index in shown_in(Output.ARRAYS)},
    )


def arrays_of_pose(pose: Pose) -> PoseArrays:
    """The arrays of one pose, without the first axis."""
    whole = arrays_of([pose])
    arrays = {name: getattr(whole, name)[0] for name in whole.__dataclass_fields__ if name != "indices"}
    return replace(whole, **arrays, indices={name: values[0] for name, values in whole.indices.items()})


def _balls(
    rows: Sequence[Sequence[Interval]], shape: tuple[int, ...]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    try:
        balls = np.array([[interval.ball() for interval in row] for row in rows], dtype=np.float64)
    except OverflowError:
        raise PkmExactError(
            "poses: a coordinate is too large for floating point; use its bounds, which are exact"
        ) from None
    balls = balls.reshape((len(rows), *shape, 2))
    return balls[..., 0].copy(), balls[..., 1].copy()


def _values(index: Index, poses: Sequence[Pose]) -> NDArray[Any]:
    return np.array([array_value(index, pose) for pose in poses], dtype=np.int64 if index.is_integer else np.float64)


def array_value(index: Index, pose: Pose) -> float:
    """The value of an index as arrays have it."""
    number = index.number(pose)
    if number is not None:
        return number
    return nan if index.undecided is None else index.undecided


def rotations_of(quaternions: NDArray[np.float64], what: str) -> Rotation:
    """The rotations of quaternions (.., 4), scalar first, for scipy; ``what`` names the caller in messages.

    Raises
    ------
    PkmExactError
        If scipy is not installed.
    """
    transform = required("scipy.spatial.transform", what, 'pip install "pkm_exact[scipy]"')
    rotations: Rotation = transform.Rotation.from_quat(quaternions[..., [1, 2, 3, 0]])
    return rotations


def frame_of(arrays: PoseArrays) -> DataFrame:
    """A pandas table of poses, numbered from 1.

    Raises
    ------
    PkmExactError
        If pandas is not installed.
    """
    pandas = required("pandas", "to_frame", "pip install pandas")
    nullable = partial(pandas.array, dtype="Int64")
    columns = dict(zip(_NAMES, np.concatenate([arrays.position, arrays.quaternion], axis=1).T, strict=True))
    frame: DataFrame = pandas.DataFrame(
        columns
        | {
            index.name: pandas.array(arrays.indices[index.name], dtype="Int64")
            if index.is_integer
            else arrays.indices[index.name]
            for index in shown_in(Output.ARRAYS)
        }
        | {"multiplicity": nullable(arrays.multiplicity), "half_width": arrays.half_width},
        index=pandas.RangeIndex(1, len(arrays.position) + 1, name="pose"),
    )
    unknown = {index.name: index.undecided for index in shown_in(Output.ARRAYS) if index.is_integer}
    for name, value in (unknown | {"multiplicity": UNKNOWN_MULTIPLICITY}).items():
        frame.loc[(frame[name] == value).fillna(False), name] = pandas.NA
    return frame


def required(module: str, what: str, command: str) -> Any:
    """An optional package, or an error that says how to install it.

    Examples
    --------
    >>> required("no_such", "to_nowhere", "pip install no_such")
    Traceback (most recent call last):
    pkm_exact.errors.PkmExactError: to_nowhere: no_such is not installed; get it with: pip install no_such
    """
    try:
        return import_module(module)
    except ImportError:
        package = module.partition(".")[0]
        raise PkmExactError(f"{what}: {package} is not installed; get it with: {command}") from None
