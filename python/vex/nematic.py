"""At which densities fluids of hard bodies become nematic."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Optional, Sequence, Tuple

import numpy as np

from . import _vex
from ._arrays import Floats, as_floats
from .bodies import BodyLike, as_body


@dataclass(frozen=True, eq=False)
class NematicPhase:
    """A fluid of one kind of bodies."""

    number_density: float  #: n, length^-3
    volume_fraction: float  #: n V; NaN of flat bodies
    reduced_density: float  #: c = n <V_ex> / 2
    order_parameter: float  #: S = <P_2(cos theta)>; 0 of an isotropic fluid
    pressure: float  #: P / kT, length^-3
    chemical_potential: float  #: mu / kT, of which an ideal gas has ln c
    cosines: Floats = field(repr=False)  #: of theta, the angle from the director
    density: Floats = field(repr=False)  #: 4 pi f(theta) at these; empty of an isotropic fluid


@dataclass(frozen=True, eq=False)
class NematicTransition:
    """What `nematic_transition` found."""

    excluded_volume: float  #: <V_ex> of random orientations, length^3
    isotropic: Optional[NematicPhase]  #: None where there is no transition
    nematic: Optional[NematicPhase]
    reason: str  #: why there is none
    grid_error: float  #: the largest relative change of either fluid's numbers from a grid half as fine
    series: Floats = field(repr=False)  #: k_l of V_ex(gamma) / <V_ex> = sum of k_l P_l(cos gamma), l = 0, 2, 4 ...
    notes: Tuple[str, ...]  #: what a reader should know of the body or of the numbers

    def __str__(self) -> str:
        if self.isotropic is None or self.nematic is None:
            return "no transition: " + self.reason
        return (f"c = {self.isotropic.reduced_density:.8g} (isotropic) and {self.nematic.reduced_density:.8g} (nematic), "
                f"S = {self.nematic.order_parameter:.5g}")


@dataclass(frozen=True)
class MixturePhase:
    """A fluid of two kinds of bodies, A and B."""

    number_densities: Tuple[float, float]  #: of A and of B, length^-3
    number_density: float  #: of both
    composition: float  #: the share of B in the number
    volume_fraction: float  #: of both; NaN where one is flat
    reduced_density: float  #: n <V_ex> / 2, <V_ex> the mean over all pairs of the fluid
    order_parameters: Tuple[float, float]
    pressure: float  #: P / kT, length^-3
    chemical_potentials: Tuple[float, float]  #: mu / kT, of which an ideal gas has the ln of its density times b_AA


@dataclass(frozen=True)
class MixtureCoexistence:
    """An isotropic and a nematic fluid of two kinds in equilibrium."""

    composition: float  #: of the isotropic fluid, as it was asked for
    isotropic: MixturePhase
    nematic: MixturePhase
    residual: float  #: the largest relative difference of the two pressures and of the chemical potentials


@dataclass(frozen=True)
class ThreeFluids:
    """An isotropic fluid and two nematic ones, all three in equilibrium."""

    isotropic: MixturePhase
    nematic: Tuple[MixturePhase, MixturePhase]  #: the one with less of B first


@dataclass(frozen=True)
class MixtureTransition:
    """What `mixture_transition` found."""

    excluded_volumes: Tuple[float, float, float]  #: <V_ex> of A with A, A with B, B with B, length^3
    found: Tuple[MixtureCoexistence, ...]  #: as far as the branch was followed
    three: Tuple[ThreeFluids, ...]  #: of bodies that are unlike enough; from there on two nematic fluids exist
    reason: str  #: why not to the end; "" where it was


def nematic_transition(body: BodyLike, *, theory: str = "onsager", trial_function: bool = False) -> NematicTransition:
    """The isotropic and the nematic fluid of a hard body that are in equilibrium: docs/guide.md.

    Parameters
    ----------
    body
        Its z axis is the one that aligns.
    theory
        ``"onsager"``, the second virial coefficient alone, exact for bodies that are infinitely thin; or
        ``"parsons-lee"``, all others scaled as those of hard spheres, for bodies with a volume.
    trial_function
        Orientations by Onsager's trial function cosh(alpha cos theta), and not by the density of least free energy.

    Returns
    -------
    NematicTransition, of the numbers that `vex_nematic` tells, the same bits (of pressure and chemical potential, which
    both fluids have to rounding, it prints the nematic one's). Where there is no transition, as of
    spheres, both fluids are None, and `reason` says why.

    Raises
    ------
    InputError
        The bodies exclude no volume, or V_ex(gamma) would take too long.
    """
    volume, isotropic, nematic, reason, grid_error, series, notes = _vex.nematic_transition(
        as_body(body)._core, str(theory), bool(trial_function))
    return NematicTransition(volume, None if isotropic is None else NematicPhase(**isotropic),
                             None if nematic is None else NematicPhase(**nematic), reason, grid_error,
                             np.array(series), tuple(notes))


def mixture_transition(a: BodyLike, b: BodyLike, compositions: Sequence[float] = (0.0, 0.25, 0.5, 0.75, 1.0), *,
                       theory: str = "onsager") -> MixtureTransition:
    """Isotropic and nematic fluids of two kinds of hard bodies that are in equilibrium.

    Parameters
    ----------
    compositions
        Shares of B in the number of bodies of the isotropic fluid, ascending from 0 to 1. At each the equilibrium of
        the least dense isotropic fluid is given. Shares within 1e-7 of 0 or 1 stand for fluids with that much of the
        other kind, or less.
    a, b, theory
        As of `nematic_transition`; the branch of equilibria begins at the fluid of A alone.

    Returns
    -------
    MixtureTransition. Equilibria of two nematic fluids without an isotropic one are not looked for.
    """
    shares = as_floats(compositions, "compositions")
    if shares.ndim != 1:
        raise _vex.UsageError(f"compositions: an array of shape {shares.shape} - give one of shape (N,)")
    volumes, found, three, reason = _vex.mixture_transition(as_body(a)._core, as_body(b)._core, shares.tolist(),
                                                            str(theory))
    return MixtureTransition(
        volumes,
        tuple(MixtureCoexistence(share, MixturePhase(**isotropic), MixturePhase(**nematic), residual)
              for share, isotropic, nematic, residual in found),
        tuple(ThreeFluids(MixturePhase(**isotropic), (MixturePhase(**one), MixturePhase(**other)))
              for isotropic, one, other in three),
        reason)
