"""Whatever is passed, a result or a Python exception comes back."""

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import vex

REFUSALS = (vex.Error, TypeError, ValueError, OverflowError)

dtypes = st.sampled_from(["f8", "f4", "f2", "i8", "u1", "?", "c16", "U3", ">f8"])
shapes = hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=8)
numbers = st.one_of(st.floats(width=64), st.sampled_from([0.0, -0.0, 1e308, -1e308, 5e-324, np.nan, np.inf, 1.0]))
likely = st.one_of(
    hnp.arrays("f8", st.tuples(st.integers(0, 5), st.sampled_from([3, 4, 6, 7])), elements=numbers),
    hnp.arrays("f8", st.tuples(st.integers(0, 5), st.just(3), st.just(3)), elements=numbers))
arrays = st.one_of(likely, dtypes.flatmap(lambda dtype: hnp.arrays(dtype, shapes)),
                   hnp.arrays("O", shapes, elements=st.one_of(st.none(), numbers, st.text())),
                   likely.map(lambda a: a[::-1]), likely.map(lambda a: a.T), likely.map(np.asfortranarray),
                   likely.map(lambda a: np.lib.stride_tricks.as_strided(a, a.shape, (0,) * a.ndim)))
anything = st.one_of(arrays, st.none(), st.text(max_size=20), st.integers(), st.floats(), st.booleans(),
                     st.lists(st.floats(), max_size=8), st.tuples(arrays, arrays))
texts = st.one_of(st.text(max_size=30), st.builds(
    lambda name, sizes: name + ":" + ",".join(map(repr, sizes)),
    st.sampled_from([name for name, _, _ in vex.named_shapes()] + ["rounded:0.1,box"]),
    st.lists(numbers, min_size=0, max_size=4)))
bodies = st.sampled_from([vex.box(1, 2, 3), vex.cone(1, 2), vex.disc(1), vex.needle(2), vex.ellipsoid(1, 2, 3),
                          vex.icosahedron(1), vex.rounded("plate:1,1", 0.25)])
quick = settings(max_examples=150, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))


def attempt(call, *arguments, **options):
    try:
        return call(*arguments, **options)
    except REFUSALS:
        return None


@quick
@given(bodies, bodies, anything, anything)
def test_queries(a, b, first, second):
    for query in (vex.overlap, vex.signed_distance, vex.distance, vex.depth, vex.contact_manifold):
        attempt(query, a, b, first)
    attempt(vex.overlap, a, b, (first, second))
    attempt(vex.ray_cast, a, first, second)
    attempt(vex.linear_cast, a, b, first, second)
    attempt(vex.time_of_impact, a, b, first, second, until=2.0)
    attempt(vex.within, a, b, first, 0.1)
    attempt(vex.excluded_volume_at, a, a, first)
    attempt(a.support, first)


@quick
@given(bodies, anything, anything)
def test_scenes(body, first, second):
    scene = attempt(vex.Scene, body, first, box=(20, 20, 20))
    scene = scene or vex.Scene(body, [[0, 0, 0, 1, 0, 0, 0]])
    attempt(scene.add, body, second)
    attempt(scene.add, [body], first, shapes=second)
    attempt(scene.move_all, second)
    for ask in (scene.overlaps_of, scene.nearest, scene.pose, scene.remove):
        attempt(ask, first)
    attempt(scene.move, first, second)
    attempt(scene.ray_cast, first, second, until=10.0)
    attempt(vex.Scene, body, first, box=second)
    scene.any_overlap()
    if len(scene) < 100:
        attempt(scene.pairs_within, 0.1)


@quick
@given(bodies, anything, anything, anything)
def test_poses_and_worlds(body, first, second, third):
    for call in (vex.inverse, vex.quaternion_of):
        attempt(call, first)
    for call in (vex.product, vex.relative_pose, vex.pose_of):
        attempt(call, first, second)
    attempt(vex.interpolated, first, second, third)
    attempt(vex.relative_pose_error, first, second, third)
    attempt(body.scaled, first)
    attempt(body.mapped, first)
    floor = vex.HalfSpace([0, 0, 1])
    pair = vex.Compound(["sphere:1", "box:1,1,1"], [[0, 0, 0, 1, 0, 0, 0], [2, 0, 0, 1, 0, 0, 0]])
    for world in (floor, pair):
        attempt(world.overlap, body, first)
        attempt(world.ray_cast, first, second, until=third)
        attempt(world.linear_cast, body, first, second, until=10.0)
    attempt(pair.time_of_impact, body, first, second, third, until=2.0)
    attempt(vex.Compound, [body], first)
    attempt(vex.Compound.of_triangles, first)
    attempt(vex.HalfSpace, first, second)


@quick
@given(bodies, anything, anything, anything)
def test_depletion_nematics_and_warm_starts(body, first, second, third):
    short = dict(trials=100, threads=2)
    attempt(vex.depletion_at, body, body, first, ball_radius=0.25, seed=second, **short)
    attempt(vex.depletion_at, body, body, [0, 0, 2, 1, 0, 0, 0], ball_radius=first, seed=second, **short)
    attempt(vex.depletion_average, body, body, first, ball_radius=0.25, law=second, seed=third, **short)
    attempt(vex.overlap_of_balls, first, second, third)
    attempt(vex.nematic_transition, "disc:1", theory=first)
    attempt(vex.mixture_transition, "needle:1", "disc:1", first, theory=second)
    state = vex.WarmStart()
    for query in (vex.signed_distance, vex.distance, vex.depth):
        attempt(query, body, body, first, warm_start=second)
        attempt(query, body, body, first, warm_start=state)
    attempt(state.__setstate__, first)


@quick
@given(texts, anything)
def test_bodies(text, something):
    made = attempt(vex.Body, text) if not text.startswith("/") else None
    if made is not None:
        repr(made), hash(made), made.volume, made.vertices
    attempt(vex.Body, something)
    attempt(vex.hull, something)
    attempt(vex.rounded, "box:1,1,1", something)

    class Shape:
        vertices = something
        faces = something
    attempt(vex.Body, Shape())
    attempt(vex.Body, Shape(), hull=True)
    attempt(vex.from_support, lambda d: something, circumradius=1.0, support_error=0.0)


@quick
@given(bodies, st.dictionaries(st.sampled_from(["rel_error", "seed", "threads", "law", "estimator", "sequence",
                                                "domain", "max_trials", "verify", "control_variate"]), anything))
def test_excluded_volume(body, options):
    if isinstance(options.get("threads"), int) and options["threads"] > 64:
        options["threads"] = 64
    attempt(vex.excluded_volume, body, trials=2000, **options)
