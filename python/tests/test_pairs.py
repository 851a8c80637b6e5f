"""Pairs of bodies against closed forms."""

import itertools

import numpy as np
import pytest

import cstk


def test_two_cubes_five_lines(query):
    cube = cstk.Body.box([0.5, 0.5, 0.5])
    nearest = query.pair_distance(cube, cstk.identity(), cube, cstk.translation(3, 0.5, 0))
    assert nearest.distance == 2 and nearest.kind == cstk.DistanceKind.EXACT
    assert nearest.lower <= 2 <= nearest.upper
    np.testing.assert_allclose(nearest.s_point - nearest.r_point, [2, 0, 0], atol=1e-15)
    np.testing.assert_array_equal(nearest.contact.normal, [-1, 0, 0])


def test_spheres_at_random(query, rng):
    for _ in range(200):
        a, b = rng.normal(size=(2, 3)) * 3
        r, s = rng.uniform(0.1, 1, 2)
        found = query.pair_distance(cstk.Body.sphere(r), cstk.translation(*a), cstk.Body.sphere(s), cstk.translation(*b))
        truth = max(0.0, np.linalg.norm(a - b) - r - s)
        assert found.distance == pytest.approx(truth, abs=1e-11)
        assert found.lower <= truth + 1e-15 and truth <= found.upper + 1e-15


def test_a_square_that_stands_for_something_near_it(query):
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    square = cstk.BodyBuilder().add_polygon(corners).set_deviation(0.1).build()
    assert square.statistics().deviation == 0.1
    found = query.pair_distance(square, cstk.identity(), square, cstk.translation(0, 0, 1))
    assert found.lower <= found.distance == pytest.approx(0.8) and found.upper == pytest.approx(1.2)
    with pytest.raises(cstk.InvalidArgumentError, match="deviation"):
        cstk.BodyBuilder().set_deviation(-1)


def test_a_rational_patch_is_a_quarter_of_a_cylinder(query):
    half = np.sqrt(0.5)
    arc = np.array([[1, 0, 0], [1, 1, 0], [0, 1, 0]])
    net = np.stack([arc, arc + [0, 0, 2]], axis=1)
    weights = np.outer([1, half, 1], [1, 1])
    body = cstk.BodyBuilder().add_bezier_patch(net, 0.01, weights, tag=4).build()
    stated = body.statistics().deviation
    assert 0 < stated <= 0.01
    place = cstk.translation(*(3 * np.array([half, half, 0]) + [0, 0, 1]))
    found = query.pair_distance(body, cstk.identity(), cstk.Body.sphere(0.5), place)
    assert found.lower <= 1.5 <= found.upper <= found.lower + 2 * stated + 1e-9 and found.witness.r_tag == 4
    query.set_refinement(1e-6)
    found = query.pair_distance(body, cstk.identity(), cstk.Body.sphere(0.5), place)
    assert found.lower <= 1.5 <= found.upper <= found.lower + 1e-6
    with pytest.raises(cstk.InvalidArgumentError, match="gap"):
        query.set_refinement(0)
    query.set_refinement(None)
    with pytest.raises(ValueError, match="weights"):
        cstk.BodyBuilder().add_bezier_patch(net, 0.01, weights.T)
    with pytest.raises(ValueError, match="points"):
        cstk.BodyBuilder().add_bezier_patch(net[0], 0.01)


def test_a_nurbs_surface_is_a_cylinder(query):
    half = np.sqrt(0.5)
    circle = np.array([[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]])
    ring = np.column_stack([circle, np.zeros(9)])
    net = np.stack([ring, ring + [0, 0, 2]], axis=1)
    weights = np.outer([1, half, 1, half, 1, half, 1, half, 1], [1, 1])
    around, along = [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], [0, 0, 1, 1]
    body = cstk.BodyBuilder().add_nurbs_surface(around, along, net, 0.01, weights, tag=5).build()
    stated = body.statistics().deviation
    assert 0 < stated <= 0.01
    for angle in np.linspace(0, 6, 13):
        place = cstk.translation(3 * np.cos(angle), 3 * np.sin(angle), 1)
        found = query.pair_distance(body, cstk.identity(), cstk.Body.sphere(0.5), place)
        assert found.lower <= 1.5 <= found.upper <= found.lower + 2 * stated + 1e-9 and found.witness.r_tag == 5
    builder = cstk.BodyBuilder()
    with pytest.raises(ValueError, match="weights"):
        builder.add_nurbs_surface(around, along, net, 0.01, weights.T)
    with pytest.raises(ValueError, match="control_points"):
        builder.add_nurbs_surface(around, along, net[0], 0.01)
    with pytest.raises(cstk.WrongSizeError, match="knots_v"):
        builder.add_nurbs_surface(around, along[:3], net, 0.01)
    with pytest.raises(cstk.InvalidArgumentError, match="knots_u: knot 2"):
        builder.add_nurbs_surface([0, 0, -1, *around[3:]], along, net, 0.01)


BODIES = {
    "capsule": (lambda: cstk.Body.capsule([0, 0, -1], [0, 0, 1], 0.25), 1.25),
    "cylinder": (lambda: cstk.Body.cylinder(0.5, 0.75), 0.75),
    "cone": (lambda: cstk.Body.cone(0.5, 2), 1.0),
    "ellipsoid": (lambda: cstk.Body.ellipsoid([0.3, 0.4, 1.1]), 1.1),
    "polyhedron": (lambda: cstk.Body.polyhedron([[0, 0, 0.7], *itertools.product((-1, 1), (-1, 1), (-1,))]), 0.7),
    "points": (lambda: cstk.Body.points([[0, 0, 0], [0, 0, 0.5]], 0.25), 0.75),
    "support": (lambda: cstk.BodyBuilder().add_support(lambda d: 0.6 * d).build(), 0.6),
    "rounded": (
        lambda: cstk.BodyBuilder().add_rounded_polygon([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], 0.125).build(),
        0.125,
    ),
    "rounded solid": (
        lambda: cstk.BodyBuilder().add_rounded_polyhedron(list(itertools.product((-1, 1), repeat=3)), 0.5).build(),
        1.5,
    ),
    "polygon": (lambda: cstk.Body.polygon([[-1, -1, 0.2], [1, -1, 0.2], [0, 1, 0.2]]), 0.2),
    "height field": (lambda: cstk.Body.height_field(np.full((3, 4), 0.3), 1.0, 1.0, -1.0), 0.3),
}


@pytest.mark.parametrize("name", BODIES)
def test_a_small_ball_above_the_top(query, name):
    make, top = BODIES[name]
    x = 0.1 if name == "height field" else 0.0
    ball = cstk.Body.sphere(0.01)
    found = query.pair_distance(make(), cstk.identity(), ball, cstk.translation(x, x / 2, top + 1.01))
    assert found.distance == pytest.approx(1, abs=1e-10)
    assert found.lower <= 1 + 1e-12 and found.upper >= 1 - 1e-12


def cube_mesh():
    vertices = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return vertices, np.array(quads)


def test_meshes_are_surfaces_unless_solid(query):
    vertices, quads = cube_mesh()
    ball, middle = cstk.Body.sphere(0.25), cstk.identity()
    surface, solid = cstk.Body.mesh(vertices, quads), cstk.Body.mesh(vertices, quads, solid=True)
    assert query.pair_distance(surface, middle, ball, middle).distance == pytest.approx(0.75)
    assert query.pair_distance(solid, middle, ball, middle).distance == 0
    assert query.pair_within(solid, middle, ball, middle) and not query.pair_within(surface, middle, ball, middle)
    assert solid.statistics().solid and surface.statistics().primitive_count == 6
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    mixed = cstk.BodyBuilder().add_mesh(vertices, np.r_[quads[:3].ravel(), triangles[:6].ravel()], [4] * 3 + [3] * 6)
    assert mixed.build().statistics().primitive_count == 9
    with pytest.raises(cstk.NotClosedError):
        cstk.Body.mesh(vertices, quads[:5], solid=True)


def test_mesh_is_scaled_and_moved(query):
    body = cstk.Body.mesh(*cube_mesh(), scale=[2, 1, 1], pose=cstk.translation(10, 0, 0))
    np.testing.assert_allclose(body.statistics().low, [8, -1, -1])
    np.testing.assert_allclose(body.statistics().high, [12, 1, 1])
    np.testing.assert_allclose(cstk.Body.mesh(*cube_mesh(), scale=3).statistics().high, [3, 3, 3])


def test_witnesses_and_penetration(query):
    cube = cstk.Body.box([1, 1, 1], tag=7)
    near = query.pair_witnesses(cube, cstk.identity(), cube, cstk.translation(2.5, 0.5, 0), 1)
    assert len(near) == 1 and near[0].r_tag == near[0].s_tag == 7 and near[0].distance == 0.5
    assert len(near.contacts_of(0)) == len(near.contacts) >= 4
    # They span what the two faces have in common.
    points = near.contacts.array["r_point"]
    np.testing.assert_array_equal([points.min(axis=0), points.max(axis=0)], [[1, -0.5, -1], [1, 1, 1]])
    np.testing.assert_array_equal(near.contacts.array["distance"], 0.5)
    np.testing.assert_array_equal(near.contacts.array["normal"], [[-1, 0, 0]] * len(near.contacts))
    assert near.gradients is None and not near.truncated
    deep = query.pair_penetration(cube, cstk.identity(), cube, cstk.translation(1.75, 0.5, 0))
    assert deep.of_whole_bodies and deep[0].depth == pytest.approx(0.25)
    np.testing.assert_allclose(deep[0].direction, [-1, 0, 0])


def test_depths_of_unions_are_bounded(query):
    builder = cstk.BodyBuilder()
    for x in (-0.75, 0.75):
        builder.add_box([1, 1, 1], cstk.translation(x, 0, 0))
    union = builder.build()
    cube = cstk.Body.box([1, 1, 1])
    # Along x the way out of the first box leads into the second.
    deep = query.pair_depth(cube, cstk.translation(-0.5, 0.5, 0), union, cstk.identity())
    assert deep.meet and deep.tight and deep.lower <= 1.5 <= deep.upper + 1e-12
    np.testing.assert_allclose(deep.translation, [0, 1.5, 0], atol=1e-12)
    away = query.pair_depth(cube, cstk.translation(9, 0, 0), union, cstk.identity())
    assert not away.meet and away.lower == away.upper == 0
    with pytest.raises(cstk.InvalidArgumentError, match="tolerance"):
        query.pair_depth(cube, cstk.identity(), union, cstk.identity(), tolerance=-1)


def test_contacts_are_left_out_where_asked(query):
    cube = cstk.Body.box([1, 1, 1])
    query.set_contacts(cstk.ContactsListed.NONE)
    near = query.pair_witnesses(cube, cstk.identity(), cube, cstk.translation(2.5, 0.5, 0), 1)
    assert near.contacts_left_out and len(near) == 1 and len(near.contacts) == 0
    assert near.contacts.array.shape == (0,)


def test_answers_outlive_the_next_call(query):
    cube, away = cstk.Body.box([1, 1, 1]), cstk.translation(2.5, 0.5, 0)
    first = query.pair_witnesses(cube, cstk.identity(), cube, away, 1)
    before = first.contacts.array.copy()
    witness = first[0]
    query.pair_witnesses(cube, cstk.identity(), cube, cstk.translation(2.1, 0, 0), 5)
    del first
    assert witness.distance == 0.5 and (before["distance"] == 0.5).all()


def test_pair_motion_of_a_falling_ball(query):
    ball, ground = cstk.Body.sphere(0.5), cstk.Body.box([5, 5, 0.5])
    still = cstk.identity()
    falls = query.pair_motion(ball, cstk.translation(0, 0, 3), cstk.translation(0, 0, 0), ground, still, still)
    assert falls.outcome == cstk.MotionOutcome.HIT and not falls
    assert falls.times[1] == pytest.approx(2 / 3, abs=2e-6)
    np.testing.assert_allclose(falls.reached[0], cstk.translation(0, 0, 3 - 3 * falls.times[1]), atol=1e-12)
    np.testing.assert_array_equal(falls.reached[1], np.eye(4))
    over = query.pair_motion(ball, cstk.translation(-9, 0, 1.5), cstk.translation(9, 0, 1.5), ground, still, still, threshold=0.4)
    assert over and over.distance is None


def test_the_plane_is_a_world_of_its_own(query):
    square = cstk.Body.polygon([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dimension=2)
    disc = cstk.Body.sphere(0.25, dimension=2)
    away = query.pair_distance(square, cstk.identity(), disc, cstk.translation(2, 2, 0))
    assert away.distance == pytest.approx(np.sqrt(2) - 0.25)
    assert query.pair_distance(square, cstk.identity(), disc, cstk.translation(0.5, 0.5, 0)).distance == 0


def test_hierarchies_are_seen_and_do_not_change_answers(query, rng, tmp_path):
    points = rng.uniform(-1, 1, (60, 3, 3))
    vertices, faces = points.reshape(-1, 3), np.arange(180).reshape(-1, 3)
    boxes = cstk.HierarchyOptions(grouping=cstk.Grouping.TOP_DOWN, wrapper=cstk.WrapperKind.ALIGNED_BOX, threads=2)
    plain, boxed = cstk.Body.mesh(vertices, faces), cstk.Body.mesh(vertices, faces, hierarchy=boxes)
    assert boxed.hierarchy_statistics().wrapper == cstk.WrapperKind.ALIGNED_BOX
    for body in plain, boxed:
        found = query.pair_distance(body, cstk.identity(), cstk.Body.points([[3, 0, 0]]), cstk.identity())
        assert found.distance == query.pair_distance(plain, cstk.identity(), cstk.Body.points([[3, 0, 0]]), cstk.identity()).distance
    level = plain.level_nodes(2)
    assert plain.level_statistics(2).node_count + plain.level_statistics(2).leaves_above == len(level)
    cover = plain.cover_nodes(8)
    assert 1 <= len(cover) <= 8
    root = plain.node(0)
    assert root.primitive is None and all(child is not None for child in root.children)
    assert np.linalg.norm(vertices - root.center, axis=1).max() <= root.radius + 1e-12
    assert plain.node_corners(0).shape == (root.corner_count, 3)
    mesh = plain.mesh_of_nodes(level)
    assert mesh.indices.max() < len(mesh.vertices) and mesh.face_sizes.sum() == len(mesh.indices)
    assert set(mesh.face_nodes) <= set(level)
    plain.show_nodes(level, tmp_path / "level.glb")
    assert (tmp_path / "level.glb").read_bytes()[:4] == b"glTF"
    triangle = plain.feature_vertices(5, cstk.FeatureKind.INTERIOR)
    np.testing.assert_allclose(triangle, points[5])
    assert plain.primitive(5).kind == cstk.PrimitiveKind.POLYGON and plain.primitive(5).tag == 5


def test_progress_is_heard_and_may_end_the_call(rng):
    builder = cstk.BodyBuilder().add_mesh(rng.uniform(-1, 1, (6000, 3)), np.arange(6000).reshape(-1, 3))
    heard = []
    builder.build(progress=heard.append)
    assert heard and heard == sorted(heard) and 0 <= heard[0] and heard[-1] <= 1
    with pytest.raises(cstk.CancelledError):
        builder.build(progress=lambda fraction: False)

    def fails(fraction):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        builder.build(progress=fails)
