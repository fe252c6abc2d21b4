"""Percolation thresholds of overlapping bodies."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _vex
from ._arrays import threads_of
from .average import _whole, excluded_volume, formula, law_of, with_error
from .bodies import Body, BodyLike, as_body

_USUAL_B = 3.0  # others that a body overlaps at the threshold: of most bodies somewhat less


@dataclass(frozen=True, eq=False)
class Percolation:
    """What `percolation` found; errors are standard errors."""

    eta_c: float  #: n_c times the mean volume; NaN of flat bodies
    std_error: float  #: of eta_c
    phi_c: float  #: 1 - exp(-eta_c), the share of space that is covered
    number_density_c: float  #: n_c, bodies in a unit of volume
    number_density_error: float
    b_c: float  #: n_c <V_ex>, how many others a body overlaps
    b_c_error: float
    excluded_volume: float  #: <V_ex>, the mean over the parts
    p_value: float  #: of a scatter about the fit of all sizes as large as this: below 0.01 sizes are too small
    without_smallest: Optional[float]  #: n_c without the smallest size, of three or more
    isotropic: bool  #: whether universal probabilities hold; else the threshold is where the sizes' own cross
    thresholds: List[Dict[str, Tuple[float, float]]]  #: of each size by each criterion: n_c there, and its error
    sizes: Tuple[float, ...]  #: edges of the cube in extents of the largest body
    numbers: List[npt.NDArray[np.uint32]] = field(repr=False)  #: of each size (N, 3): bodies when x, y, z wrapped
    undecided: int = 0  #: pairs taken for apart that were not proven to be
    seconds: float = 0.0

    def __str__(self) -> str:
        if math.isnan(self.eta_c):
            return f"n_c = {with_error(self.number_density_c, self.number_density_error)}"
        return f"eta_c = {with_error(self.eta_c, self.std_error)}, B_c = {with_error(self.b_c, self.b_c_error)}"


def percolation(bodies: Union[BodyLike, Sequence[BodyLike]], fractions: Optional[Sequence[float]] = None, *,
                sizes: Sequence[float] = (4, 6, 12), realisations: Optional[int] = None,
                std_error: Optional[float] = None, seconds: Optional[float] = None,
                law: Union[str, "_vex.OrientationLaw"] = "isotropic", shell: float = 0.0, seed: int = 1,
                threads: Optional[int] = None) -> Percolation:
    """The percolation threshold of overlapping bodies, placed uniformly in a periodic cube: docs/percolation.md.

    Parameters
    ----------
    bodies, fractions
        A body, or several with their parts of the number.
    sizes
        Edges of the cube in extents, twice the circumradius of the largest body; extrapolated to infinite space.
    realisations, std_error, seconds
        Realisations of each size (50 or more), standard error of eta_c, or time, whichever comes first; 1000 realisations where none
        is given.
    law
        How each body is turned, on its own: as of `excluded_volume`, but for "fixed" and "angle", which are about two.
        "uniform-angle": the polar angle is uniform, as some have drawn it; B_c is not known then.
    shell
        Bodies connect where their gap is at most this.
    seed, threads
        Realisations are functions of the seed and their number, those of `vex_percolate`, for any number of threads.
    """
    listed = list(bodies) if isinstance(bodies, (list, tuple)) else [bodies]
    made = [as_body(body) for body in listed]
    shares = np.array([1.0] * len(made) if fractions is None else [float(x) for x in fractions])
    if len(shares) != len(made) or not (shares > 0.0).all() or not np.isfinite(shares).all():
        raise _vex.UsageError("fractions: give a number above 0 for each body")
    shares = shares / shares.sum()
    if not shell >= 0.0 or not math.isfinite(shell):
        raise _vex.UsageError("shell: give a finite length from 0 on")
    if not made:
        raise _vex.UsageError("bodies: give one")
    edges_of = tuple(sorted(float(size) for size in sizes))
    if not edges_of or not all(2.0 <= size < math.inf for size in edges_of) or len(set(edges_of)) < len(edges_of):
        raise _vex.UsageError("sizes: give different numbers from 2 on")
    if len(edges_of) > 64:
        raise _vex.UsageError("sizes: give at most 64")
    most = 2**26 - 1 if realisations is None else _whole(realisations, "realisations")
    if realisations is None and std_error is None and seconds is None:
        most = 1000
    fewest_of_all = int(_vex.fewest_realisations)
    if not fewest_of_all <= most < 2**26:
        raise _vex.UsageError(f"realisations: give from {fewest_of_all}, which it takes to know the errors, to 67108863")
    if (std_error is not None and not std_error > 0.0) or (seconds is not None and not seconds > 0.0):
        raise _vex.UsageError("std_error, seconds: give a number above 0")

    connecting = [body.rounded(0.5 * shell) if shell > 0.0 else body for body in made]
    extent = max(2.0 * body.circumradius for body in connecting)
    mean_volume = float(sum(share * body.volume for share, body in zip(shares, made)))
    if std_error is not None and mean_volume == 0.0:
        raise _vex.UsageError("std_error: eta of flat bodies is 0 - use realisations or seconds")
    uniform_angle = law == "uniform-angle"
    chosen_law = law_of("isotropic" if uniform_angle else law)
    isotropic, _ = _mean_excluded_volume(connecting, shares, law_of("isotropic"), seed, threads)
    if math.isnan(isotropic):
        raise _vex.UsageError("bodies of one's own, whose measures are not known - give others")
    if not isotropic > 0.0:
        raise _vex.InputError("bodies that never overlap (needles have no width) - give others, or a shell")
    mean, mean_error = isotropic, 0.0
    if uniform_angle:
        mean = math.nan
    elif chosen_law.name != "isotropic":
        mean, mean_error = _mean_excluded_volume(connecting, shares, chosen_law, seed, threads)
    forbidden = mean if mean > 1e-9 * isotropic else isotropic
    edges = [size * extent for size in edges_of]
    parts = [(body._core, float(share)) for body, share in zip(connecting, shares)]
    systems = [_vex.PercolationSystem(parts, chosen_law, _whole(seed, "seed"), uniform_angle, edge, k, _USUAL_B * edge**3 / forbidden)
               for k, edge in enumerate(edges)]

    isotropic_system = bool(systems[0].is_isotropic)
    if not isotropic_system and len(edges_of) < 2:
        raise _vex.UsageError("sizes: of a law that is not isotropic one size says nothing - give two or more")
    start = time.monotonic()
    numbers: List[Any] = [np.empty((0, 3), dtype=np.uint32) for _ in edges]
    undecided = 0
    found: Any = None
    while True:
        fewest = min(len(rows) for rows in numbers)
        if fewest >= most or (fewest >= fewest_of_all and seconds is not None and time.monotonic() - start >= seconds):
            break
        if std_error is not None and fewest >= 200:
            _, found = _vex.percolation_threshold(isotropic_system, list(edges_of), edges, numbers)
            if found["std_error"] * mean_volume <= std_error:
                break
            rest = math.hypot(found["offset_error"], found["universal_error"]) * mean_volume
            if rest >= std_error and found["scatter_error"] * mean_volume <= 0.25 * std_error:
                break  # the extrapolation alone is more uncertain
        # A round ends where one run without interruption would look at its error: at 64, 128, ... and then eighths.
        goal = min(most, fewest + max(64, fewest // 8))
        for k, system in enumerate(systems):
            if len(numbers[k]) < goal:
                more, n_undecided = system.run(len(numbers[k]), goal - len(numbers[k]), threads_of(threads))
                numbers[k] = np.concatenate([numbers[k], more])
                undecided += n_undecided
    thresholds, found = _vex.percolation_threshold(isotropic_system, list(edges_of), edges, numbers)
    spent = time.monotonic() - start

    density, error = found["density"], found["std_error"]
    is_flat = mean_volume == 0.0
    eta = math.nan if is_flat else density * mean_volume
    return Percolation(
        eta_c=eta, std_error=math.nan if is_flat else error * mean_volume, phi_c=-math.expm1(-eta),
        number_density_c=density, number_density_error=error, b_c=density * mean,
        b_c_error=math.hypot(error * mean, density * mean_error), excluded_volume=mean, p_value=found["p_value"],
        without_smallest=found["without_smallest"], isotropic=isotropic_system, thresholds=thresholds, sizes=edges_of, numbers=numbers,
        undecided=undecided, seconds=spent)


def _mean_excluded_volume(bodies: List[Body], shares: Any, law: "_vex.OrientationLaw", seed: int,
                          threads: Optional[int]) -> Tuple[float, float]:
    """Over all pairs of parts, with its error; NaN where a body of one's own tells no measures."""
    mean, variance = 0.0, 0.0
    for i, a in enumerate(bodies):
        for j, b in enumerate(bodies[:i + 1]):
            weight = float(shares[i] * shares[j]) * (1.0 if i == j else 2.0)
            if law.name == "isotropic":
                value, error = formula(a, b), 0.0
            else:
                result = excluded_volume(a, b, law=law, seed=seed, threads=threads, rel_error=1e-5, seconds=5.0)
                reference = result.reference
                value = result.value if reference is None else reference.value
                error = result.std_error if reference is None else reference.std_error
            mean += weight * value
            variance += (weight * error) ** 2
    return mean, math.sqrt(variance)
