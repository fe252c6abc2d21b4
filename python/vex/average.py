"""The average excluded volume of two bodies: by Monte Carlo, beside the value that is known."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy.typing as npt

from . import _vex
from ._arrays import as_floats, as_number, as_quaternions, threads_of
from .bodies import BodyLike, as_body


@dataclass(frozen=True)
class Reference:
    """What <V_ex> is known to be, from other means than the run."""

    kind: str  #: "formula", V_A + V_B + (M_A S_B + M_B S_A) / 4 pi; or "exact", the mean of mixed volumes over the law
    value: float  #: length^3
    std_error: float  #: of "exact", a bound on rounding included; of the formula 0
    reduced: float  #: value / sqrt(V_A V_B); NaN where a body is flat
    b2: float  #: value / 2


@dataclass(frozen=True, eq=False)
class ExcludedVolume:
    """The volume that A forbids to B's centre, averaged over their relative orientation. Volumes in length^3."""

    value: float  #: the estimate; NaN where a run was interrupted before its first trial
    std_error: float  #: its standard error
    interval: Tuple[float, float]  #: of 95 % confidence
    reduced: float  #: value / sqrt(V_A V_B); NaN where a body is flat or its volume not known
    b2: float  #: value / 2, the second virial coefficient of hard bodies
    reference: Optional[Reference]  #: the known value, where there is one
    reference_reason: str  #: why there is none
    z: Optional[float]  #: (value - reference) / std_error, where there is one
    z_reason: str  #: why there is none
    estimator: Optional[str]  #: what was run; None where nothing was
    sequence: str  #: "random" or "sobol"
    chosen_because: str  #: in a sentence
    complete: bool  #: whether a stop rule ended the run
    stopped_by: str  #: which one
    trials: int  #: or evaluations of the estimator's function
    hits: Optional[int]  #: None of estimators without hits
    undecided: int  #: trials of which it is not proven whether the bodies overlap: half of their share is in the error
    seconds: float  #: of the run
    law: str  #: how the bodies are turned
    seed: int
    note: str = ""  #: where nothing was sampled: why
    decided_by: Dict[str, int] = field(default_factory=dict, repr=False)  #: how many trials each stage decided

    @property
    def formula(self) -> Optional[float]:
        """V_A + V_B + (M_A S_B + M_B S_A) / 4 pi, where the orientations are isotropic."""
        return self.reference.value if self.reference is not None and self.reference.kind == "formula" else None

    @property
    def exact(self) -> Optional[float]:
        """The exact average over a law that is not isotropic, where there is one."""
        return self.reference.value if self.reference is not None and self.reference.kind == "exact" else None

    def to_dict(self) -> Dict[str, Any]:
        """All of it, of what JSON has but for NaN, which is None."""
        def plain(value: Any) -> Any:
            if isinstance(value, float):
                return value if math.isfinite(value) else None
            if isinstance(value, Reference):
                return {name: plain(x) for name, x in vars(value).items()}
            if isinstance(value, tuple):
                return [plain(x) for x in value]
            return value
        return {name: plain(value) for name, value in vars(self).items()}

    def __str__(self) -> str:
        text = f"<V_ex> = {with_error(self.value, self.std_error)}"
        if self.reference is not None:
            text += f", {self.reference.kind} {self.reference.value:.10g}"
        if self.z is not None:
            text += f", z = {self.z:+.2f}"
        if not self.complete:
            text += " (not complete: " + self.stopped_by + ")"
        return text

    def _repr_html_(self) -> str:
        rows = [("⟨V<sub>ex</sub>⟩", with_error(self.value, self.std_error)), ("B<sub>2</sub>", f"{self.b2:.10g}")]
        if not math.isnan(self.reduced):
            rows.append(("⟨V<sub>ex</sub>⟩/√(V<sub>A</sub>V<sub>B</sub>)", f"{self.reduced:.8g}"))
        if self.reference is not None:
            rows.append((self.reference.kind, f"{self.reference.value:.12g}"))
        if self.z is not None:
            rows.append(("z", f"{self.z:+.2f}"))
        rows.append(("estimator", f"{self.estimator}, {self.trials} trials, {self.seconds:.3g} s"))
        if not self.complete:
            rows.append(("not complete", self.stopped_by))
        cells = "".join(f"<tr><td>{name}</td><td>{value}</td></tr>" for name, value in rows)
        return f"<table>{cells}</table>"


def with_error(value: float, error: float) -> str:
    """``11.0007(10)``: the error in units of the last digits."""
    if not math.isfinite(value) or not error > 0.0 or not math.isfinite(error):
        return f"{value:.10g}"
    digits = max(0, 1 - math.floor(math.log10(error)))
    shown = round(error * 10.0**digits)
    if shown >= 100 and digits > 0:
        digits -= 1
        shown = round(error * 10.0**digits)
    return f"{value:.{digits}f}({shown})"


class Interrupted(KeyboardInterrupt):
    """Ctrl-C while a run went on; `result` is what was done until then."""

    def __init__(self, result: ExcludedVolume) -> None:
        super().__init__(str(result))
        self.result = result


def law_of(law: Union[str, "_vex.OrientationLaw"]) -> "_vex.OrientationLaw":
    """Of ``"isotropic"``, ``"aligned"``, ``"fixed:W,X,Y,Z"``, ``"cone:DEG"``, ``"angle:DEG"``, ``"onsager:ALPHA"``,
    ``"maier-saupe:A"``, ``"table:FILE"``."""
    if isinstance(law, _vex.OrientationLaw):
        return law
    return _vex.OrientationLaw.parse(str(law))


#: Called several times a second with trials, relative error, seconds.
Progress = Callable[[int, float, float], None]


def excluded_volume(a: BodyLike, b: Optional[BodyLike] = None, *, rel_error: Optional[float] = None,
                    trials: Optional[int] = None, seconds: Optional[float] = None,
                    law: Union[str, "_vex.OrientationLaw"] = "isotropic", estimator: str = "", sequence: str = "",
                    domain: str = "", seed: int = 1, threads: Optional[int] = None, max_trials: Optional[int] = None,
                    control_variate: Union[BodyLike, Sequence[BodyLike]] = (), verify: bool = False, quick_verdicts: bool = True,
                    exact_average: bool = True, progress: Union[None, bool, Progress] = None,
                    on_interrupt: str = "raise") -> ExcludedVolume:
    """The average excluded volume of two bodies, by Monte Carlo, beside its known value.

    Parameters
    ----------
    a, b
        Bodies; `b` is `a` unless given.
    rel_error, trials, seconds
        The run ends at this relative standard error, number of trials, or time, whichever comes first; 1e-4 where none
        is given.
    law
        How the bodies are turned: ``"isotropic"``, ``"aligned"``, ``"fixed:W,X,Y,Z"`` (B's quaternion in A's frame),
        ``"cone:DEG"``, ``"angle:DEG"``, ``"onsager:ALPHA"``, ``"maier-saupe:A"``, ``"table:FILE"``; or an
        `OrientationLaw`: ``.table(cosines, densities)``, ``.each(a, b)`` of laws that differ, ``.about("x")``.
    estimator
        A name of `estimators`; chosen by a pilot run where it is not given, by the seed and the bodies alone.
    sequence, domain, max_trials, control_variate, verify, quick_verdicts, exact_average
        As the options of `vex_mesh`.
    seed, threads
        The result is a function of the seed, the bodies and the settings, the same bits for any number of threads, and
        those that `vex_mesh` prints (but for runs that end by the clock).
    progress
        True: a bar by tqdm, where that is installed. Or a function of trials, relative error and seconds.
    on_interrupt
        What Ctrl-C does: ``"raise"`` raises `Interrupted`, a KeyboardInterrupt that has the partial result;
        ``"return"`` returns it, ``complete`` being False. Of a body of one's own whose function is interrupted there
        is none: its value is NaN.

    Returns
    -------
    ExcludedVolume

    Examples
    --------
    >>> r = vex.excluded_volume("box:1,1,1", rel_error=1e-3)
    >>> print(r.formula)
    11.0
    """
    if on_interrupt not in ("raise", "return"):
        raise _vex.UsageError(f"on_interrupt: {on_interrupt!r} - give 'raise' or 'return'")
    body_a = as_body(a)
    body_b = body_a if b is None else as_body(b)
    chosen_law = law_of(law)
    if rel_error is None and trials is None and seconds is None:
        rel_error = 1e-4
    options: Dict[str, Any] = {"law": chosen_law, "seed": _whole(seed, "seed"), "threads": threads_of(threads),
                               "verify": bool(verify), "quick_verdicts": bool(quick_verdicts),
                               "exact_average": bool(exact_average)}
    if rel_error is not None:
        options["rel_error"] = as_number(rel_error, "rel_error")
    if seconds is not None:
        options["seconds"] = as_number(seconds, "seconds")
    for name, count in (("trials", trials), ("max_trials", max_trials)):
        if count is not None:
            options[name] = _whole(count, name)
    for name, text in (("estimator", estimator), ("sequence", sequence), ("domain", domain)):
        if not isinstance(text, str):
            raise TypeError(f"{name}: {text!r} - give a name")
        if text:
            options[name] = text
    listed = control_variate if isinstance(control_variate, (list, tuple)) else [control_variate]
    controls = [as_body(body)._core for body in listed]
    if controls:
        options["control_variate"] = controls

    report, close = _progress_of(progress)
    try:
        values, error = _vex.excluded_volume(body_a._core, body_b._core, options, report)
    except KeyboardInterrupt as raised:  # in a support function of somebody's own: the run has no result
        values, error = _nothing_done(), raised
    finally:
        close()
    tally = values.pop("tally")
    reference = values.pop("reference")
    unproven = values.pop("unproven")
    samples_poses = values.pop("samples_poses")
    note = values.pop("no_run_reason")
    result = ExcludedVolume(reference=None if reference is None else Reference(**reference), trials=tally["trials"],
                            hits=tally["hits"] if samples_poses else None, undecided=tally["undecided"],
                            decided_by=tally["decided_by"], law=chosen_law.name, seed=options["seed"], note=note,
                            **values)
    if isinstance(error, KeyboardInterrupt):
        if on_interrupt == "raise":
            raise Interrupted(result) from None
    elif error is not None:
        raise error
    if unproven:
        raise RuntimeError(f"{unproven} verdicts could not be proven again")
    return result


def _nothing_done() -> Dict[str, Any]:
    nan = math.nan
    return dict(value=nan, std_error=nan, interval=(nan, nan), reduced=nan, b2=nan, reference=None,
                reference_reason="interrupted", z=None, z_reason="interrupted", estimator=None, samples_poses=False,
                sequence="", chosen_because="", complete=False, stopped_by="interrupted", no_run_reason="", seconds=nan,
                unproven=0, tally=dict(trials=0, hits=0, undecided=0, decided_by={}))


def _whole(value: Any, what: str) -> int:
    """10**7 and 1e7 alike."""
    try:
        whole = int(value)
    except (TypeError, ValueError, OverflowError):
        raise _vex.UsageError(f"{what}: {value!r} - give a whole number") from None
    if whole != value or not 0 <= whole < 2**64:
        raise _vex.UsageError(f"{what}: {value!r} - give a whole number from 0 on")
    return whole


def _progress_of(progress: Union[None, bool, Progress]) -> Tuple[Optional[Progress], Callable[[], None]]:
    if progress is None or progress is False:
        return None, lambda: None
    if progress is not True:
        if not callable(progress):
            raise TypeError(f"progress: {progress!r} - give True, or a function of trials, relative error and seconds")
        return progress, lambda: None
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None, lambda: None
    bar = tqdm(unit=" trials", unit_scale=True)

    def show(trials: int, relative_error: float, _seconds: float) -> None:
        bar.n = trials
        bar.set_postfix_str(f"relative error {relative_error:.2g}")
    return show, bar.close


def excluded_volume_at(a: BodyLike, b: BodyLike, rotations: npt.ArrayLike, *, seed: int = 1,
                       threads: Optional[int] = None) -> npt.NDArray[Any]:
    """The excluded volume at fixed orientations of B in A's frame, from mixed volumes: no sampling of positions.

    Parameters
    ----------
    rotations
        Quaternions (N, 4), rows of w, x, y, z of any length but 0; or matrices (N, 3, 3). Or one of them.

    Returns
    -------
    array of fields ``value`` and ``error``, length^3, one for each rotation. Of polytopes, and of two ellipsoids, each
    is one sum and the error its rounding; where curved parts are summed over random points there is their standard error
    in it.
    """
    quaternions, single = as_quaternions(rotations)
    found = _vex.excluded_volume_at(as_body(a)._core, as_body(b)._core, quaternions, _whole(seed, "seed"),
                                    threads_of(threads))
    return found[0] if single else found


def excluded_volume_of_angle(a: BodyLike, b: BodyLike, angles: npt.ArrayLike, *, seed: int = 1,
                             threads: Optional[int] = None) -> npt.NDArray[Any]:
    """V_ex(gamma): the excluded volume with B's z axis at an angle to A's, both bodies spun about their own axes.

    Parameters
    ----------
    angles
        In degrees, from 0 to 180, of any shape.

    Returns
    -------
    array of fields ``value`` and ``error`` as of `excluded_volume_at`, of the shape of `angles`.
    """
    degrees = as_floats(angles, "angles")
    found = _vex.excluded_volume_of_angle(as_body(a)._core, as_body(b)._core, degrees.ravel(), _whole(seed, "seed"),
                                          threads_of(threads))
    return found.reshape(degrees.shape)[()]


def formula(a: BodyLike, b: Optional[BodyLike] = None) -> float:
    """V_A + V_B + (M_A S_B + M_B S_A) / 4 pi: <V_ex> of uniformly random orientations, length^3."""
    body_a = as_body(a)
    return _vex.formula(body_a._core, (body_a if b is None else as_body(b))._core)


def estimators() -> List[Tuple[str, str]]:
    """The names of the estimators and what they are."""
    return _vex.estimators()
