import math
import pickle
import types

import numpy as np
import pytest

import vex


def test_named_bodies_have_their_measures():
    body = vex.capsule(1.0, 0.25)
    assert body == vex.Body("capsule:1,0.25") and body.kind == "capsule"
    assert body.volume == pytest.approx(math.pi * 0.25**2 * (1 + 4 * 0.25 / 3), rel=1e-14)
    assert body.surface_area == pytest.approx(2 * math.pi * 0.25 * (1 + 2 * 0.25), rel=1e-14)
    assert body.integrated_mean_curvature == pytest.approx(math.pi + 4 * math.pi * 0.25, rel=1e-14)
    assert vex.sphere(2.0).mean_radius == pytest.approx(2.0, rel=1e-15)
    assert vex.box(1, 2, 3).vertices.shape == (8, 3) and not vex.sphere(1).is_polytope


def test_every_named_shape_is_a_function_with_its_parameters():
    for name, parameters, _ in vex.named_shapes():
        if name == "rounded":
            continue
        sizes = [0.5 + 0.25 * k for k in range(parameters.count(",") + 1)]
        if parameters.startswith("N,"):
            sizes[0] = 5
        if name == "cut-sphere":
            sizes[0] = 2
        if name == "spindle":
            sizes[0] = 4
        assert getattr(vex, name.replace("-", "_"))(*sizes) == vex.Body(name + ":" + ",".join(map(str, sizes)))


def test_support_points_are_the_farthest():
    rng = np.random.default_rng(1)
    for body in (vex.box(1, 2, 3), vex.cylinder(1, 0.5), vex.icosahedron(1), vex.ellipsoid(1, 2, 3)):
        directions = rng.normal(size=(100, 3))
        points = body.support(directions)
        assert points.shape == (100, 3)
        heights = points @ directions.T
        assert (np.diag(heights) >= heights.max(axis=0) - 1e-12).all()
        assert (body.support(directions[7]) == points[7]).all()
    with pytest.raises(vex.InputError, match="direction 1"):
        vex.sphere(1).support([[1, 0, 0], [0, 0, 0]])


def test_faces_run_counter_clockwise_and_meet_along_edges():
    for body, n in ((vex.box(1, 2, 3), 6), (vex.tetrahedron(1), 4), (vex.octahedron(1), 8), (vex.dodecahedron(1), 12),
                    (vex.icosahedron(1), 20)):
        vertices, faces = body.vertices, body.faces
        assert len(faces) == n
        edges = {(int(a), int(b)) for face in faces for a, b in zip(face, np.roll(face, -1))}
        assert all((b, a) in edges for a, b in edges)
        assert len(vertices) - len(edges) // 2 + len(faces) == 2
        for face in faces:
            normal = np.cross(vertices[face[1]] - vertices[face[0]], vertices[face[2]] - vertices[face[0]])
            assert normal @ (vertices[face[0]] - vertices.mean(axis=0)) > 0.0
    assert len(vex.plate(1, 2).faces) == 2 and vex.needle(1).faces == [] and vex.sphere(1).faces == []


def test_bodies_of_objects_with_vertices_and_faces():
    cube = vex.box(1, 1, 1)
    like_trimesh = types.SimpleNamespace(vertices=cube.vertices,
                                         faces=np.array([[f[0], f[k], f[k + 1]] for f in cube.faces for k in (1, 2)]))
    like_coxeter = types.SimpleNamespace(vertices=cube.vertices, faces=cube.faces)
    points_alone = types.SimpleNamespace(vertices=cube.vertices)
    for source in (like_trimesh, like_coxeter, points_alone):
        body = vex.Body(source)
        assert body == cube and body.volume == pytest.approx(1.0, rel=1e-14)
    dented = types.SimpleNamespace(vertices=np.concatenate([cube.vertices, [[0.0, 0.0, 0.0]]]),
                                   faces=[f for f in cube.faces[1:]]
                                   + [[cube.faces[0][k], cube.faces[0][(k + 1) % 4], 8] for k in range(4)])
    with pytest.raises(vex.InputError, match="convex"):
        vex.Body(dented)
    assert vex.Body(dented, hull=True).volume == pytest.approx(1.0, rel=1e-14)
    with pytest.raises(TypeError):
        vex.Body(3.0)
    with pytest.raises(vex.InputError):
        vex.Body(types.SimpleNamespace(vertices=cube.vertices, faces=[[0, 1, 9]]))


def test_meshes_are_read_and_refused(meshes, tmp_path):
    pebble = vex.load(meshes / "pebble.obj")
    assert pebble.kind == "polyhedron" and pebble.report["n_vertices"] == len(pebble.vertices) == 300
    assert vex.Body(str(meshes / "pebble.obj")) == pebble
    broken = tmp_path / "broken.obj"
    broken.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.raises(vex.InputError, match="not closed|open"):
        vex.load(broken)
    with pytest.raises(vex.InputError):
        vex.load(tmp_path / "missing.obj")
    with pytest.raises(vex.UsageError, match="sphere"):
        vex.Body("spher:1")
    with pytest.raises(vex.UsageError, match="sphere:R"):
        vex.Body("sphere")
    with pytest.raises(vex.InputError):
        vex.box(1, -1, 1)
    with pytest.raises(vex.InputError):
        vex.box(1, math.nan, 1)


def test_scaled_and_rounded(meshes):
    assert vex.Body("box:1,2,3", unit_volume=True).volume == pytest.approx(1.0, rel=1e-14)
    assert vex.box(1, 2, 3).scaled(2.0) == vex.box(2, 4, 6)
    pebble = vex.load(meshes / "pebble.obj")
    assert vex.load(meshes / "pebble.obj", unit_volume=True).volume == pytest.approx(1.0, rel=1e-12)
    assert pebble.scaled(2.0).volume == pytest.approx(8 * pebble.volume, rel=1e-12)
    rounded = pebble.rounded(0.5)
    assert rounded.volume > pebble.volume and rounded.scaled(2.0).volume == pytest.approx(8 * rounded.volume, rel=1e-12)
    assert vex.Body(f"rounded:0.5,{meshes / 'pebble.obj'}") == rounded
    assert vex.rounded("box:1,1,1", 0.1) == vex.Body("rounded:0.1,box:1,1,1")
    for factor in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises((vex.UsageError, vex.InputError)):
            vex.box(1, 1, 1).scaled(factor)


def test_pickled_bodies_are_the_same_bits(meshes):
    rng = np.random.default_rng(2)
    points = rng.normal(size=(50, 3))
    for body in (vex.cone(1, 2), vex.load(meshes / "gem.obj", scale=1.5), vex.hull(points), vex.hull(points).rounded(0.25),
                 vex.Body("box:1,2,3", unit_volume=True)):
        again = pickle.loads(pickle.dumps(body))
        assert again == body and hash(again) == hash(body) and repr(again) == repr(body)
        assert (again.volume, again.surface_area, again.integrated_mean_curvature) == \
            (body.volume, body.surface_area, body.integrated_mean_curvature)
        settings = dict(trials=8192, estimator="radial", seed=3)
        assert vex.excluded_volume(again, **settings).value == vex.excluded_volume(body, **settings).value


def test_equality_is_that_of_the_numbers():
    points = vex.box(1, 1, 1).vertices
    assert vex.hull(points) == vex.hull(points[::-1]) == vex.box(1, 1, 1)
    assert vex.hull(points) != vex.hull(points * (1 + 2**-52)) and vex.box(1, 1, 1) != "box:1,1,1"
    assert len({vex.box(1, 1, 1), vex.Body("box:1.0,1,1"), vex.sphere(1)}) == 2


def test_a_body_of_ones_own():
    def support(directions):
        return directions / np.linalg.norm(directions, axis=1, keepdims=True)

    ball = vex.from_support(support, circumradius=1 + 1e-14, inradius=1 - 1e-14, support_error=1e-15)
    poses = [[x, 0, 0, 1, 0, 0, 0] for x in (0.0, 1.999, 2.001)]
    assert vex.overlap(ball, ball, poses).tolist() == [1, 1, 0]
    assert vex.overlap(ball, ball, [2, 0, 0, 1, 0, 0, 0]) == -1
    assert vex.distance(ball, "sphere:1", poses[2])["value"] == pytest.approx(0.001, abs=1e-9)
    result = vex.excluded_volume(ball, "sphere:0.5", trials=1000, estimator="hit-or-miss", domain="box", threads=2)
    assert abs(result.value - 4 / 3 * math.pi * 1.5**3) < 5 * result.std_error and result.reference is None
    assert math.isnan(ball.volume)

    with pytest.raises(vex.InputError, match="circumradius"):
        vex.from_support(support, circumradius=0.9, support_error=1e-15)
    with pytest.raises(vex.InputError, match="finite"):
        vex.from_support(lambda d: d * np.nan, circumradius=1, support_error=0)
    with pytest.raises(vex.InputError, match="point"):
        vex.from_support(lambda d: np.zeros((2, 3)), circumradius=1, support_error=0)
    with pytest.raises(ZeroDivisionError):
        vex.from_support(lambda d: 1 / 0, circumradius=1, support_error=0)

    calls = 0

    def failing(directions):
        nonlocal calls
        calls += 1
        if calls > 3000:
            raise RuntimeError("enough")
        return support(directions)

    mortal = vex.from_support(failing, circumradius=1 + 1e-14, support_error=1e-15, check=False)
    with pytest.raises(RuntimeError, match="enough"):
        vex.excluded_volume(mortal, "box:1,1,1", trials=10**6, threads=2)
    with pytest.raises(RuntimeError, match="enough"):
        vex.distance(mortal, "box:1,1,1", poses * 50, threads=2)


def test_pictures_for_notebooks():
    for body in (vex.box(1, 2, 3), vex.sphere(1), vex.disc(1), vex.needle(1)):
        html = body._repr_html_()
        assert "data:image/png;base64," in html and "volume" in html


def test_moments_of_inertia():
    box = vex.box(1, 2, 3)
    assert box.moment_of_inertia == pytest.approx(np.diag([6 * 13 / 12, 6 * 10 / 12, 6 * 5 / 12]), rel=1e-13)
    assert vex.sphere(2).moment_of_inertia == pytest.approx(np.eye(3) * 0.4 * 4 * vex.sphere(2).volume, rel=1e-14)
    shifted = vex.hull(box.vertices + [10, 20, 30])
    assert shifted.centroid == pytest.approx([10, 20, 30], rel=1e-14)
    assert shifted.moment_of_inertia == pytest.approx(box.moment_of_inertia, rel=1e-12, abs=1e-12)
    # Of what is curved: the hull of many of its points, from within.
    directions = np.random.default_rng(4).normal(size=(20000, 3))
    for text in ("ellipsoid:1,2,3", "capsule:2,0.5", "cylinder:2,1", "cone:2,1", "frustum:2,1,0.5", "hemisphere:1"):
        body = vex.Body(text)
        rim = [[r * math.cos(a), r * math.sin(a), z] for a in np.linspace(0, 2 * math.pi, 400) for z in (-1.0, 1.0)
               for r in (1.0, 0.5)] if text[0] in "cf" and text[1] != "a" else np.empty((0, 3))
        support = np.concatenate([body.support(directions)] + ([body.support(np.array(rim) + [0, 0, 0])] if len(rim) else []))
        inner = vex.hull(support)
        assert 0.99 * body.volume < inner.volume <= body.volume
        assert body.centroid == pytest.approx(inner.centroid, abs=5e-3)
        assert body.moment_of_inertia == pytest.approx(inner.moment_of_inertia, rel=2e-2, abs=1e-2 * body.volume)
        assert (np.diag(body.moment_of_inertia) >= np.diag(inner.moment_of_inertia) * (1 - 1e-9)).all()
    for flat in (vex.disc(1), vex.rounded("box:1,1,1", 0.1)):
        with pytest.raises(vex.UsageError):
            flat.moment_of_inertia


def test_bodies_without_an_exact_form_are_what_they_are():
    ball = vex.superball(1.0, 0.5)
    assert ball.volume == pytest.approx(vex.sphere(0.5).volume, rel=1e-13)
    assert ball == vex.Body("superball:1,0.5") and hash(ball) == hash(vex.superball(1, 0.5))
    assert ball != vex.superball(1.5, 0.5) and ball != ball.scaled(2.0)
    assert pickle.loads(pickle.dumps(ball)) == ball
    assert vex.overlap(ball, ball, [[0.9, 0, 0, 1, 0, 0, 0], [1.1, 0, 0, 1, 0, 0, 0]]).tolist() == [1, 0]
    assert vex.lens(1, 0.5).rounded(0.1) == vex.lens(1.0, 0.5).rounded(0.1)
    with pytest.raises(vex.InputError, match="exponent"):
        vex.superball(0.4, 1.0)


def test_the_hull_of_a_file_is_a_text(tmp_path):
    (tmp_path / "points.dat").write_text("0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.25 0.25 0.25\n")
    (tmp_path / "points.xyz").write_text("0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.25 0.25 0.25\n")
    body = vex.Body(f"points:{tmp_path / 'points.dat'}")
    assert body.volume == pytest.approx(1 / 6, rel=1e-14) and len(body.vertices) == 4
    assert body == vex.Body(f"hull:{tmp_path / 'points.xyz'}")
    rounded = vex.Body(f"rounded:0.5,hull:{tmp_path / 'points.xyz'}", unit_volume=True)
    assert rounded.volume == pytest.approx(1.0, rel=1e-12)
    with pytest.raises(vex.UsageError, match="hull:FILE"):
        vex.Body("hull:box:1,1,1")


def test_one_factor_does_not_mirror():
    points = np.random.default_rng(3).normal(size=(40, 3))
    for body in (vex.hull(points), vex.box(1, 1, 1), vex.hull(points).rounded(0.1), vex.superball(1.5, 1.0),
                 vex.cone(1, 1).scaled((1, 2, 3)), vex.Body(types.SimpleNamespace(vertices=points))):
        for factor in (-1.0, -2, 0.0, math.nan, math.inf):
            with pytest.raises(vex.UsageError, match="mirrored"):
                body.scaled(factor)
    assert vex.hull(points).scaled((-1, -1, -1)) == vex.hull(-points)


def test_a_mirror_image_of_a_mirror_image_is_the_body(meshes):
    for body in (vex.superball(1.5, 1.0), vex.superellipsoid(1, 2, 3, 0.5, 0.7), vex.lens(1.0, 0.4),
                 vex.superball(1.5, 1.0).rounded(0.1), vex.superball(1.5, 1.0).scaled((1, 2, 3)), vex.cone(1, 1),
                 vex.load(meshes / "gem.obj")):
        twice = body.mirrored().mirrored()
        assert twice == body and hash(twice) == hash(body) and body.mirrored().scaled((1, 1, 1)) == body.mirrored()
        assert twice.support([0.3, 0.2, -0.9]).tolist() == body.support([0.3, 0.2, -0.9]).tolist()
        turned = body.scaled((1, -1, 1)).mirrored()
        assert turned == body.scaled((-1, -1, 1)) == body.mirrored().scaled((1, -1, 1))
        assert pickle.loads(pickle.dumps(turned)) == turned
