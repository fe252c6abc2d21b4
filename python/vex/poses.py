"""Poses one after another, the other way round, between two others, and of two bodies as one sees the other.

A pose world_from_a takes points of a's frame to the world: ``R @ point + t``. Functions take poses in every form that
queries do (`vex.queries`), one or many, and one beside many; what they give is a `Pose`, which queries take as it is.
It has the doubles of the C++ library: all of this rounds, what comes out is a pose of doubles near the one that is
meant, and a query answers about those doubles.

>>> import vex
>>> at_a, at_b = [5, 0, 0, 1, 0, 0, 1], [5, 3, 0, 1, 0, 0, 0]
>>> int(vex.overlap("box:1,2,3", "sphere:1", vex.relative_pose(at_a, at_b)))
0
"""

from __future__ import annotations

from typing import Any, NamedTuple, Tuple

import numpy as np
import numpy.typing as npt

from . import _vex
from ._arrays import Floats, Poses, as_floats, as_number, as_poses, as_rows, repeated


class Pose(NamedTuple):
    """One pose, or an array of them: rotations and translations, as queries take them.

    ``world_from_a * a_from_b`` is world_from_b.
    """

    rotation: Floats  #: (3, 3) or (N, 3, 3)
    translation: Floats  #: length, (3,) or (N, 3)

    def __mul__(self, other: Poses) -> "Pose":  # type: ignore[override]
        if np.isscalar(other):
            return NotImplemented
        return product(self, other)

    def __rmul__(self, other: Poses) -> "Pose":  # type: ignore[override]
        if np.isscalar(other):
            return NotImplemented
        return product(other, self)

    def inverse(self) -> "Pose":
        """b_from_a of a_from_b: see `vex.inverse`."""
        return inverse(self)

    @property
    def rows(self) -> Floats:
        """(7,) or (N, 7): x, y, z, qw, qx, qy, qz. Rounded once more: the rotation that queries make of a quaternion is
        near this one."""
        return np.concatenate([self.translation, quaternion_of(self)], axis=-1)


Pose.__array_ufunc__ = None  # type: ignore[attr-defined]  # rows * pose is a product of poses, and not NumPy's


def _pose(arrays: Any, single: bool) -> Pose:
    rotations, translations = arrays
    return Pose(rotations[0], translations[0]) if single else Pose(rotations, translations)


def _pairs(first: Poses, second: Poses) -> Tuple[Any, bool]:
    """Rows and translations of both, as many of either, and whether either was one pose alone."""
    given = [as_poses(first), as_poses(second)]
    n = max(len(rows) for rows, _, _ in given) if all(len(rows) for rows, _, _ in given) else 0
    arrays: Any = ()
    for rows, translations, _ in given:
        arrays += (repeated(rows, n, "poses"), None if translations is None else repeated(translations, n, "poses"))
    return arrays, all(single for _, _, single in given)


def pose_of(quaternions: npt.ArrayLike, translations: npt.ArrayLike = (0.0, 0.0, 0.0)) -> Pose:
    """The rotation of the quaternion w + xi + yj + zk, then the translation.

    Parameters
    ----------
    quaternions
        (N, 4) or (4,), rows of w, x, y, z of any length but 0.
    translations
        (N, 3) or (3,), length; one of either or as many of both.

    Raises
    ------
    InputError
        A row is no pose; the message names it.
    """
    q, single_q = as_rows(quaternions, 4, "quaternions")
    t, single_t = as_rows(translations, 3, "translations")
    n = max(len(q), len(t)) if min(len(q), len(t)) > 0 else 0
    rows = np.concatenate([repeated(t, n, "translations"), repeated(q, n, "quaternions")], axis=1)
    return _pose(_vex.placed(rows, None), single_q and single_t)


def quaternion_of(poses: Poses) -> Floats:
    """Quaternions (N, 4) or (4,) of length 1, w, x, y, z, of the rotations of poses; of q and -q either may come."""
    rows, translations, single = as_poses(poses)
    found = _vex.quaternion_of(rows, translations)
    return found[0] if single else found


def product(a_from_b: Poses, b_from_c: Poses) -> Pose:
    """a_from_c: first `b_from_c`, then `a_from_b`. R = R_1 R_2, t = R_1 t_2 + t_1, each operation rounded.

    Raises
    ------
    InputError
        Rotations have drifted from being some by more than 1e-6, after some 10^9 products; `pose_of` and
        `quaternion_of` make them anew.
    """
    arrays, single = _pairs(a_from_b, b_from_c)
    return _pose(_vex.product(*arrays), single)


def inverse(a_from_b: Poses) -> Pose:
    """b_from_a: R^T and -(R^T t), each operation rounded."""
    rows, translations, single = as_poses(a_from_b)
    return _pose(_vex.inverse(rows, translations), single)


def interpolated(from_: Poses, to: Poses, part: npt.ArrayLike) -> Pose:
    """The pose at this part of the way between two.

    The frame turns about one axis, evenly and by the shorter arc (K. Shoemake, 1985), while its origin moves in a
    straight line, evenly. At 0 and 1 the given poses, bit for bit.

    Parameters
    ----------
    part
        From 0 to 1; or an array (M,) of parts: of one pair of poses M of them, of N pairs one each.

    Raises
    ------
    UsageError
        A part is not from 0 to 1.
    """
    arrays, single = _pairs(from_, to)
    parts = as_floats(part, "part")
    if parts.ndim > 1:
        raise _vex.UsageError(f"part: an array of shape {parts.shape} - give a number, or one of shape (N,)")
    single, parts = single and parts.ndim == 0, parts.reshape(-1)
    n = max(len(arrays[0]), len(parts)) if min(len(arrays[0]), len(parts)) > 0 else 0
    first, first_t, second, second_t = (None if array is None else repeated(array, n, "poses") for array in arrays)
    return _pose(_vex.interpolated(first, first_t, second, second_t, repeated(parts, n, "part")),  # type: ignore[arg-type]
                 single)


def relative_pose(world_from_a: Poses, world_from_b: Poses) -> Pose:
    """a_from_b: what queries of two bodies that both have a pose in the world are asked about.

    R = R_a^T R_b, t = R_a^T (t_b - t_a), each operation rounded. It is off from what the two poses say by no more than
    `relative_pose_error`, however far they are from the world's origin.
    """
    arrays, single = _pairs(world_from_a, world_from_b)
    return _pose(_vex.relative_pose(*arrays), single)


def relative_pose_error(world_from_a: Poses, world_from_b: Poses, reach_b: float,
                        ball_radius_a: float = 0.0) -> Any:
    """How far `relative_pose` can put a point of B off from where the two poses as given have it, proven.

    Bodies that are apart, or deep in each other, by more are so for the poses as given.

    Parameters
    ----------
    reach_b, ball_radius_a
        B's `Body.reach` and A's `Body.ball_radius`, lengths.

    Returns
    -------
    A length, or an array (N,) of them: some 60 roundings of the bodies' sizes and of how far they are from each other.
    """
    arrays, single = _pairs(world_from_a, world_from_b)
    first, first_t, second, second_t = arrays
    found = _vex.relative_pose_error(first, first_t, second, second_t, as_number(reach_b, "reach_b"),
                                     as_number(ball_radius_a, "ball_radius_a"))
    return float(found[0]) if single else found
