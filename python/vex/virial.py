"""Virial coefficients of hard bodies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional, Tuple, Union

from . import _vex
from ._arrays import as_number, threads_of
from .average import _whole, law_of, with_error
from .bodies import BodyLike, as_body


@dataclass(frozen=True)
class VirialCoefficient:
    """One coefficient; errors are standard errors."""

    n: int
    reduced: float  #: B_n / B2^(n-1)
    std_error: float
    per_volume: float  #: B_n / V^(n-1); NaN of flat bodies
    per_volume_std_error: float
    samples: int  #: clusters of n bodies
    sign_settled: bool  #: whether it is three standard errors from 0
    complete: bool
    undecided: int  #: bunches of clusters with a pair that was not decided; part of the error

    def __str__(self) -> str:
        return f"B{self.n}/B2^{self.n - 1} = {with_error(self.reduced, self.std_error)}"


@dataclass(frozen=True)
class VirialCoefficients:
    """What `virial_coefficients` found."""

    b2: float  #: length^3; NaN where it is not known
    b2_per_volume: float
    higher: Tuple[VirialCoefficient, ...]  #: n = 3 ... order, or one alone
    complete: bool
    seconds: float

    def __str__(self) -> str:
        return ", ".join(str(one) for one in self.higher)


def virial_coefficients(body: BodyLike, *, order: int = 4, only: Optional[int] = None, rel_error: Optional[float] = None,
                        seconds: Optional[float] = None, samples: Optional[int] = None,
                        law: Union[str, "_vex.OrientationLaw"] = "isotropic", seed: int = 1,
                        threads: Optional[int] = None) -> VirialCoefficients:
    """B3 to B8 of a hard convex body, by Monte Carlo over clusters of overlapping bodies: docs/virials.md.

    Parameters
    ----------
    order
        The last coefficient, 3 to 8.
    only
        This coefficient alone, in place of all up to ``order``: it has the whole time.
    rel_error, seconds, samples
        The run of each coefficient ends at this ratio of its standard error to its size, or after so many clusters; all
        of them after this time; whichever comes first. 1e-3 and 60 s where none is given.
    law
        How each body is turned, on its own: ``"isotropic"``, ``"aligned"``, ``"cone:DEG"``, ``"onsager:ALPHA"``,
        ``"maier-saupe:A"``, ``"table:FILE"``.
    seed, threads
        The result is that of `vex_virial`, the same bits for any number of threads (but for runs that end by the clock).
    """
    b2, b2_per_volume, higher, complete, taken = _vex.virial_coefficients(
        as_body(body)._core, 3 if only is None else _whole(only, "only"),
        _whole(order, "order") if only is None else _whole(only, "only"), None if rel_error is None else as_number(rel_error, "rel_error"),
        None if seconds is None else as_number(seconds, "seconds"),
        None if samples is None else _whole(samples, "samples"),
        law_of(law), _whole(seed, "seed"), threads_of(threads))
    return VirialCoefficients(b2, b2_per_volume, tuple(VirialCoefficient(**one) for one in higher), complete, taken)
