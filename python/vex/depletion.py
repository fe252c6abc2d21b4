"""What ideal balls that two hard bodies exclude do to them: the depletion attraction of Asakura and Oosawa.

The centre of a ball of radius r is never nearer than r to a body: not within its depletion shell, the body rounded by r.
Where the shells of two bodies overlap the balls have more room. With n balls in a unit of volume of a reservoir the free
energy of the pair at a pose is -n kT times the volume of that overlap, and infinite where the bodies themselves overlap.
"""

from __future__ import annotations

from typing import Any, Dict, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _vex
from ._arrays import Poses, as_floats, as_number, as_poses, threads_of
from .average import _whole, law_of
from .bodies import BodyLike, as_body


def depletion_at(a: BodyLike, b: BodyLike, poses: Poses, *, ball_radius: float, rel_error: Optional[float] = None,
                 trials: Optional[int] = None, seconds: Optional[float] = None, seed: Union[int, Sequence[int]] = 1,
                 threads: Optional[int] = None, max_trials: int = 10**9) -> Any:
    """The volume in which the depletion shells of two bodies overlap, by Monte Carlo, at each pose.

    Parameters
    ----------
    a, b, poses
        As of `vex.overlap`.
    ball_radius
        Of the depletant, above 0.
    rel_error, trials, seconds, max_trials
        The run of each pose ends at this relative standard error, number of points, or time, whichever comes first;
        1e-2 where none is given.
    seed
        One, or one for each pose: with one for all, neighbours on a curve are asked about the same points and err alike.
    threads
        The result is that of `vex_depletion` with the seed of its row, the same bits for any number (but for runs that
        end by the clock).

    Returns
    -------
    array (N,) of fields ``bodies``, the verdict on the bodies themselves (1, 0, -1); ``overlap_volume`` of the shells,
    whether or not the bodies overlap, and its ``std_error``, length^3; ``trials``, ``undecided`` and ``complete``.
    """
    rows, translations, single = as_poses(poses)
    found = _vex.depletion_at(as_body(a)._core, as_body(b)._core, rows, translations, _seeds(seed, len(rows)),
                              _options(ball_radius, rel_error, trials, seconds, max_trials, threads))
    return found[0] if single else found


def depletion_average(a: BodyLike, b: BodyLike, distances: npt.ArrayLike, *, ball_radius: float,
                      law: Union[str, "_vex.OrientationLaw"] = "isotropic", rel_error: Optional[float] = None,
                      trials: Optional[int] = None, seconds: Optional[float] = None,
                      seed: Union[int, Sequence[int]] = 1, threads: Optional[int] = None,
                      max_trials: int = 10**9) -> Any:
    """The same over all directions from A's origin to B's and the orientations of a law.

    Parameters
    ----------
    distances
        Of the bodies' origins, from 0 on: (N,), or one.
    law
        As of `vex.excluded_volume`.

    Others as of `depletion_at`; both means have a run of their own.

    Returns
    -------
    array (N,) of fields ``free_share``, of the orientations at which the bodies do not overlap, and
    ``free_share_error``; ``overlap_volume`` of the shells, where the bodies do not overlap and 0 where they do, and
    ``overlap_volume_error``, length^3; ``mean_of_free``, its mean over those orientations, and ``mean_of_free_error``,
    a bound of the standard error, NaN where there are none; ``trials``, ``undecided`` and ``complete``.
    """
    lengths = as_floats(distances, "distances")
    if lengths.ndim > 1:
        raise _vex.UsageError(f"distances: an array of shape {lengths.shape} - give one of shape (N,)")
    found = _vex.depletion_average(as_body(a)._core, as_body(b)._core, lengths.ravel(), law_of(law),
                                   _seeds(seed, lengths.size),
                                   _options(ball_radius, rel_error, trials, seconds, max_trials, threads))
    return found.reshape(lengths.shape)[()]


def overlap_of_balls(radius_1: npt.ArrayLike, radius_2: npt.ArrayLike, distance: npt.ArrayLike) -> Any:
    """The volume in which two balls overlap whose centres are this far apart, length^3; of arrays too."""
    given = (as_floats(radius_1, "radii"), as_floats(radius_2, "radii"), as_floats(distance, "distances"))
    if not all((lengths >= 0.0).all() and np.isfinite(lengths).all() for lengths in given):
        raise _vex.UsageError("overlap_of_balls: a length below 0, or not finite - give lengths from 0 on")
    try:
        lengths = np.broadcast_arrays(*given)
    except ValueError:
        raise _vex.UsageError(f"overlap_of_balls: arrays of shapes {[x.shape for x in given]} - give one shape") from None
    volumes = _vex.overlap_of_balls(*(np.ascontiguousarray(x).ravel() for x in lengths))
    return volumes.reshape(lengths[0].shape)[()]


def _seeds(seed: Union[int, Sequence[int]], n: int) -> npt.NDArray[np.uint64]:
    if np.ndim(seed) == 0:
        return np.full(n, _whole(seed, "seed"), dtype=np.uint64)
    seeds = [_whole(one, "seed") for one in np.asarray(seed, dtype=object).ravel()]
    if len(seeds) != n:
        raise _vex.UsageError(f"seed: {len(seeds)} of them for {n} runs - give one, or one for each")
    return np.array(seeds, dtype=np.uint64)


def _options(ball_radius: float, rel_error: Optional[float], trials: Optional[int], seconds: Optional[float],
             max_trials: int, threads: Optional[int]) -> Dict[str, Any]:
    return {"ball_radius": as_number(ball_radius, "ball_radius"),
            "rel_error": None if rel_error is None else as_number(rel_error, "rel_error"),
            "trials": None if trials is None else _whole(trials, "trials"),
            "seconds": None if seconds is None else as_number(seconds, "seconds"),
            "max_trials": _whole(max_trials, "max_trials"), "threads": threads_of(threads)}
