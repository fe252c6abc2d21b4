"""What users pass, as arrays that the compiled part takes."""

from __future__ import annotations

from typing import Any, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _vex

Floats = npt.NDArray[np.float64]
#: Poses: an array (N, 7) or (7,); a pair of rotations (N, 3, 3) or (3, 3) and translations (N, 3) or (3,); or matrices
#: (N, 4, 4) or (4, 4) of both, whose last row is 0, 0, 0, 1.
Poses = Union[npt.ArrayLike, Tuple[npt.ArrayLike, npt.ArrayLike]]


def as_floats(values: npt.ArrayLike, what: str) -> Floats:
    """A contiguous array of doubles; TypeError for what is not real numbers."""
    try:
        array = np.asarray(values)
    except ValueError as error:  # of rows that are not as long as each other
        raise _vex.UsageError(f"{what}: not an array ({error})") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{what}: not an array of real numbers (dtype {array.dtype})")
    with np.errstate(over="ignore"):
        return np.ascontiguousarray(array, dtype=np.float64).reshape(array.shape)


def as_number(value: Any, what: str) -> float:
    """A double; UsageError, which names it, for what is none."""
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise _vex.UsageError(f"{what}: {value!r} - give a number") from None


def as_rows(values: npt.ArrayLike, width: int, what: str) -> Tuple[Floats, bool]:
    """An array (N, width), and whether it was one row (width,) alone."""
    array = as_floats(values, what)
    if array.ndim == 1 and array.shape[0] == width:
        return array.reshape(1, width), True
    if array.ndim != 2 or array.shape[1] != width:
        raise _vex.UsageError(f"{what}: an array of shape {array.shape} - give one of shape (N, {width})")
    return array, False


def as_poses(poses: Poses) -> Tuple[Floats, Optional[Floats], bool]:
    """Rows and translations as the compiled part takes them, and whether there was one pose without an axis for it."""
    if isinstance(poses, (tuple, list)) and len(poses) == 2 and _is_rotation(poses[0]):
        rotations = as_floats(poses[0], "rotations")
        translations = as_floats(poses[1], "translations")
        if rotations.shape[-2:] != (3, 3) or rotations.ndim not in (2, 3) or translations.ndim not in (1, 2) \
                or translations.shape[-1] != 3:
            raise _vex.UsageError(f"poses: rotations of shape {rotations.shape} and translations of shape "
                                  f"{translations.shape} - give (N, 3, 3) and (N, 3)")
        single = rotations.ndim == 2 and translations.ndim == 1
        rotations = rotations.reshape(-1, 3, 3)
        translations = translations.reshape(-1, 3)
        n = max(len(rotations), len(translations)) if min(len(rotations), len(translations)) > 0 else 0
        if len(rotations) not in (1, n) or len(translations) not in (1, n):
            raise _vex.UsageError(f"poses: {len(rotations)} rotations and {len(translations)} translations - give as "
                                  "many of both, or one of either")
        return (np.ascontiguousarray(np.broadcast_to(rotations[:n] if n == 0 else rotations, (n, 3, 3))),
                np.ascontiguousarray(np.broadcast_to(translations[:n] if n == 0 else translations, (n, 3))), single)
    array = as_floats(poses, "poses")  # type: ignore[arg-type]
    if array.shape[-2:] == (4, 4) and array.ndim in (2, 3):
        return _of_matrices(array)
    if array.shape == (7,):
        return array.reshape(1, 7), None, True
    if array.ndim != 2 or array.shape[1] != 7:
        raise _vex.UsageError(f"poses: an array of shape {array.shape} - give one of shape (N, 7), rows of x, y, z, qw, "
                              "qx, qy, qz; a pair of rotations (N, 3, 3) and translations (N, 3); or matrices (N, 4, 4)")
    return array, None, False


def _is_rotation(values: Any) -> bool:
    try:
        shape = np.shape(values)
    except ValueError:
        return False
    return len(shape) >= 2 and shape[-2:] != (4, 4)


def _of_matrices(array: Floats) -> Tuple[Floats, Optional[Floats], bool]:
    single = array.ndim == 2
    matrices = array.reshape(-1, 4, 4)
    wrong = np.flatnonzero((matrices[:, 3] != (0.0, 0.0, 0.0, 1.0)).any(axis=1))
    if len(wrong):
        raise _vex.InputError(f"pose {wrong[0]}: the last row of a matrix is {matrices[wrong[0], 3].tolist()} - give "
                              "matrices of a rotation and a translation, whose last row is 0, 0, 0, 1")
    return np.ascontiguousarray(matrices[:, :3, :3]), np.ascontiguousarray(matrices[:, :3, 3]), single


def as_quaternions(rotations: npt.ArrayLike) -> Tuple[Floats, bool]:
    """Quaternions (N, 4), rows of w, x, y, z, of which rotations (N, 3, 3) are made."""
    array = as_floats(rotations, "rotations")
    if array.shape[-2:] == (3, 3) and array.ndim in (2, 3):
        return _quaternions_of(array.reshape(-1, 3, 3)), array.ndim == 2
    return as_rows(array, 4, "rotations")


def _quaternions_of(r: Floats) -> Floats:
    """By the largest of the four components, so that nothing cancels."""
    off = np.abs(np.einsum("nij,nik->njk", r, r) - np.eye(3)).max(initial=0.0)
    if not off <= 1e-6 or not (np.linalg.det(r) > 0.0).all():
        raise _vex.InputError(f"not rotations (max|R^T R - 1| = {off:.2g}, or a reflection among them)")
    squares = np.empty((len(r), 4))  # 4 q^2
    trace = np.trace(r, axis1=1, axis2=2)
    squares[:, 0] = 1.0 + trace
    for k in range(3):
        squares[:, 1 + k] = 1.0 - trace + 2.0 * r[:, k, k]
    largest = squares.argmax(axis=1)
    q = np.empty((len(r), 4))
    across = (r[:, 2, 1] - r[:, 1, 2], r[:, 0, 2] - r[:, 2, 0], r[:, 1, 0] - r[:, 0, 1])  # 4 w (x, y, z)
    along = {(0, 1): r[:, 0, 1] + r[:, 1, 0], (0, 2): r[:, 0, 2] + r[:, 2, 0], (1, 2): r[:, 1, 2] + r[:, 2, 1]}
    for i in range(4):
        rows = largest == i
        q[rows, i] = squares[rows, i]
        for j in range(4):
            if j == i:
                continue
            if i == 0 or j == 0:
                product = across[max(i, j) - 1]
            else:
                product = along[(min(i, j) - 1, max(i, j) - 1)]
            q[rows, j] = product[rows]
    return np.ascontiguousarray(q)


def repeated(array: Any, n: int, what: str) -> Any:
    """As many rows as n: the one that there is so often, or those that there are."""
    if len(array) == n:
        return array
    if len(array) != 1 and n != 0:
        raise _vex.UsageError(f"{what}: {len(array)} rows beside {n} - give as many, or one")
    return np.ascontiguousarray(np.broadcast_to(array[:1] if n else array[:0], (n,) + array.shape[1:]))


def together(*vectors: Tuple[npt.ArrayLike, str]) -> Tuple[List[Any], bool]:
    """Arrays (N, 3) of as many rows, and whether each was one row alone."""
    arrays, singles = zip(*(as_rows(values, 3, what) for values, what in vectors))
    n = max(len(array) for array in arrays) if min(len(array) for array in arrays) > 0 else 0
    return [repeated(array, n, what) for array, (_, what) in zip(arrays, vectors)], all(singles)


def as_many(rows: Any, translations: Any, vectors: List[Any]) -> Tuple[Any, Any, List[Any]]:
    """Poses and what goes with each, as many of all of them."""
    counts = [len(rows)] + [len(v) for v in vectors if v is not None]
    n = max(counts) if min(counts) > 0 else 0
    return (repeated(rows, n, "poses"), None if translations is None else repeated(translations, n, "poses"),
            [None if v is None else repeated(v, n, "velocities or motions") for v in vectors])


def threads_of(threads: Optional[int]) -> int:
    """0, which stands for all cores, where there is none."""
    if threads is None:
        return 0
    try:
        n = int(threads)
    except (TypeError, ValueError, OverflowError):
        n = 0
    if n < 1 or n != threads:
        raise _vex.UsageError(f"threads: {threads!r} - give a whole number from 1 on, or None for one a core")
    return min(n, 1024)
