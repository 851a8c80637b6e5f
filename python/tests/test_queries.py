"""Queries at a configuration against closed forms, brute force and central differences."""

import math

import numpy as np
import pytest
from conftest import PlanarArm

import cstk


def test_class_and_distance_of_a_planar_arm(query, rng):
    arm, seen = PlanarArm(2.2), set()
    for q in rng.uniform(-math.pi, math.pi, (500, 2)):
        truth = arm.clearance(q)
        place = query.classify(arm.cobject, q)
        seen.add(place)
        assert place == (cstk.Class.INSIDE if truth <= 0 else cstk.Class.OUTSIDE)
        found = query.distance(arm.cobject, q)
        assert found.distance == pytest.approx(max(truth, 0), abs=1e-12)
        assert found.lower <= max(truth, 0) + 1e-14 and max(truth, 0) - 1e-14 <= found.upper
        assert query.within(arm.cobject, q, 0.5) == (truth <= 0.5)
        poses = arm.space.link_poses(q)
        assert query.classify_at_link_poses(arm.cobject, poses) == place
        assert query.explain_at_link_poses(arm.cobject, poses).point_class == place
        assert query.distance_at_link_poses(arm.cobject, poses).distance == found.distance
        assert query.within_at_link_poses(arm.cobject, poses, 0.5) == (truth <= 0.5)
        assert len(query.witnesses_at_link_poses(arm.cobject, poses, 9)) == 2
    assert seen == {cstk.Class.INSIDE, cstk.Class.OUTSIDE}


def test_gradients_are_slopes_of_the_distance(arm, query, rng):
    checked = 0
    for q in rng.uniform(-math.pi, math.pi, (100, 2)):
        found = query.gradients(arm.cobject, q, 9)
        assert found.gradients.shape == (len(found.contacts), 2)
        if arm.clearance(q) < 0.05:
            continue
        row = found.gradients[found[0].first_contact]
        h = 1e-6
        slopes = [(arm.clearance(q + e) - arm.clearance(q - e)) / (2 * h) for e in np.eye(2) * h]
        first, second = sorted(witness.distance for witness in found)
        if second - first > 1e-4:
            np.testing.assert_allclose(row, slopes, atol=1e-7)
            checked += 1
    assert checked > 50


def test_signed_distances_have_slopes_on_both_sides(query, rng):
    arm, checked, kinks = PlanarArm(2.2), {True: 0, False: 0}, 0
    for q in rng.uniform(-math.pi, math.pi, (200, 2)):
        found = query.signed_distances(arm.cobject, q, 9)
        assert found.gradients.shape == (len(found), 2)
        pair, row, h = found[0], found.gradients[0], 1e-6
        truth = arm.clearance(q)
        if truth > 0:
            assert pair.distance == pytest.approx(truth, abs=1e-12)
        if abs(pair.distance) < 1e-3 or pair.gradient_kind != cstk.GradientKind.DERIVATIVE:
            continue
        near = [query.signed_distances(arm.cobject, q + e, 9)[0].distance for e in (*(np.eye(2) * h), *(np.eye(2) * -h))]
        slopes = np.subtract(near[:2], near[2:]) / (2 * h)
        # Another pair may be nearest beside q.
        if np.abs(slopes - row).max() < 1e-5:
            checked[pair.distance > 0] += 1
        else:
            kinks += 1
    assert min(checked.values()) > 3 and kinks <= 2


def test_pseudo_normal_is_all_at_once(arm, query):
    q = [1.2, 0.3]
    found = query.pseudo_normal(arm.cobject, q, 9, normalize=True)
    assert found.point_class == query.classify(arm.cobject, q)
    assert found.distance.distance == query.distance(arm.cobject, q).distance
    np.testing.assert_allclose(np.linalg.norm(found.list.gradients, axis=1), 1)


def test_witnesses_name_their_objects(arm, query):
    found = query.witnesses(arm.cobject, [1.2, 0.3], 9, max_count=1)
    assert found.truncated and len(found) == 1
    witness = found[0]
    assert witness.s_object == arm.object and witness.s_data == "the disc" and witness.s_link is None
    assert witness.cobject == arm.cobject.number and witness.r_data is None and witness.coordinate is None
    assert query.version(arm.environment) == found.environment_version == arm.environment.version
    away = query.distance(arm.cobject, [-1.5, 0], max_distance=0.5)
    assert away.kind == cstk.DistanceKind.BEYOND_MAX and away.witness is None and away.r_point is None


def test_sets_follow_the_algebra(arm, query, rng):
    # With ranges: half-spaces are of coordinates that do not turn on circles.
    space = cstk.Space(arm.robot, [cstk.interval(-4, 4)] * 2)
    disc = cstk.CObject.ball(space, [1, 0], 0.7)
    box = cstk.CObject.box(space, [0, -1], [2, 1])
    plane = cstk.CObject.halfspace(space, [3, 4], 2.5)
    own = cstk.CObject.predicate(
        space,
        lambda q: cstk.Class.INSIDE if q[1] <= 0 else cstk.Class.OUTSIDE,
        lambda q: max(q[1], 0),
        lambda q: [0, 1],
    )
    for q in rng.uniform(-1.5, 2.5, (300, 2)):
        in_disc = math.hypot(q[0] - 1, q[1]) <= 0.7
        in_box = 0 <= q[0] <= 2 and -1 <= q[1] <= 1
        below = q[1] <= 0
        for cobject, truth in (
            (disc | box, in_disc or in_box),
            (disc & own, in_disc and below),
            (box - disc, in_box and not in_disc),
            (~box, not in_box),
            (plane, 3 * q[0] + 4 * q[1] <= 2.5),
            (own, below),
            (cstk.CObject.union([disc, box, own]), in_disc or in_box or below),
            (cstk.CObject.intersection([disc, box, own]), in_disc and in_box and below),
        ):
            assert (query.classify(cobject, q) == cstk.Class.INSIDE) == truth
        assert query.distance(own, q).distance == max(q[1], 0)


def test_limits_world_and_floor(arm, query):
    space = cstk.Space(arm.robot, [cstk.interval(-1, 1), cstk.circle()], [-3, -0.5, -1, 3, 0.5, 1])
    limits, world = cstk.CObject.beyond_limits(space), cstk.CObject.beyond_world(space)
    assert query.classify(limits, [1.25, 0]) == cstk.Class.INSIDE
    assert query.distance(limits, [0.75, 0]).distance == pytest.approx(0.25)
    assert query.distance(limits, [0.75, 0]).witness.coordinate == 0
    assert query.classify(world, [0.9, 0]) == cstk.Class.INSIDE
    assert query.distance(world, [0, 0]).distance == pytest.approx(0.5)
    floor = cstk.CObject.below_floor(space, [0, 1, 0], -0.5)
    assert query.distance(floor, [0, 0]).distance == pytest.approx(0.4)
    assert query.classify(floor, [-0.9, 0]) == cstk.Class.INSIDE
    near = cstk.CObject.below_floor(space, [0, 1, 0], -0.5, links=[0], contact_epsilon=0.5)
    assert query.classify(near, [0, 0]) == cstk.Class.CONTACT


def test_margins_and_allowed_pairs(arm, query):
    q = [0.9, 0.4]
    truth = arm.clearance(q)
    wider = cstk.CObject.induced(arm.space, arm.environment, margin=0.25, contact_epsilon=0.5)
    assert query.distance(wider, q).distance == pytest.approx(truth - 0.25)
    first_only = cstk.CObject.induced(arm.space, arm.environment, links=[0], ids=[arm.object])
    allowed = cstk.CObject.induced(arm.space, arm.environment, allowed=[(1, arm.object)])
    assert query.distance(first_only, q).distance == query.distance(allowed, q).distance > truth


def test_explanations_name_the_leaves(arm, query):
    obstacles = arm.cobject.with_data("obstacles")
    limits = cstk.CObject.box(arm.space, [-1, -1], [1, 1]).with_data("box")
    both = obstacles | limits
    found = query.explain(both, [0.5, 0])
    assert found.point_class == cstk.Class.INSIDE
    assert {leaf.data: leaf.decisive for leaf in found.leaves} == {"obstacles": False, "box": True}
    assert {leaf.data: leaf.leaf_class for leaf in found.leaves}["box"] == cstk.Class.INSIDE
    assert obstacles.data == "obstacles" and arm.cobject.data is None


def test_link_pairs(query):
    builder = cstk.RobotBuilder(2)
    bar = cstk.Body.capsule([0, 0, 0], [1, 0, 0], 0.1, dimension=2)
    last = -1
    for i in range(3):
        at = cstk.translation(1, 0, 0) if i else None
        last = builder.add_link(cstk.JointKind.REVOLUTE, body=bar, parent=last, at=at)
    space = cstk.Space(builder.build())
    pairs = query.find_link_pairs(space, samples=200, seed=3, progress=lambda part: True)
    verdicts = {(pair.r_link, pair.s_link): pair.verdict for pair in pairs.pairs}
    assert verdicts[0, 1] == verdicts[1, 2] == cstk.PairVerdict.ADJACENT
    np.testing.assert_array_equal(pairs.tested, [[0, 2]])
    itself = cstk.CObject.induced_links(space, pairs.tested)
    assert query.classify(itself, [0, 0, 0]) == cstk.Class.OUTSIDE
    assert query.classify(itself, [0, 2.5, 2.5]) == cstk.Class.INSIDE
    assert query.distance(itself, [0, 0, 0]).distance == pytest.approx(0.8)
    seen = []
    proved = query.prove_clear_pairs(itself, max_blocks=2000, progress=lambda part: seen.append(part) or True)
    assert seen[0] == 0 and seen[-1] == 1
    for q in np.random.default_rng(1).uniform(-3, 3, (200, 3)):
        assert query.classify(proved, q) == query.classify(itself, q)
    with pytest.raises(cstk.CancelledError):
        query.prove_clear_pairs(itself, progress=lambda part: False)
    with pytest.raises(cstk.InvalidArgumentError, match="max_blocks"):
        query.prove_clear_pairs(itself, max_blocks=0)


def test_pictures(arm, tmp_path):
    arm.cobject.show([1, 0.5], tmp_path / "arm.glb")
    assert (tmp_path / "arm.glb").read_bytes()[:4] == b"glTF"
    with pytest.raises(cstk.UnsupportedError, match="arm.svg"):
        arm.cobject.show([1, 0.5], str(tmp_path / "arm.svg"))
    arm.cobject.show_path([[1, 0.5], [1.2, 0.5]], 2, tmp_path / "way.glb")
    assert b'"animations"' in (tmp_path / "way.glb").read_bytes()
    with pytest.raises(cstk.InvalidArgumentError, match="seconds"):
        arm.cobject.show_path([[1, 0.5], [1.2, 0.5]], 0, tmp_path / "way.glb")


def test_limits_of_work(arm, query):
    query.set_limit(1)
    with pytest.raises(cstk.LimitError):
        query.gradients(arm.cobject, [1, 0.5], 9)
    query.set_limit(0)
    query.gradients(arm.cobject, [1, 0.5], 9)
    work = query.statistics(reset=True)
    assert work.primitive_pairs > 0 and query.statistics().primitive_pairs == 0


def test_the_nearest_with_its_gradient(arm, query, rng):
    for q in rng.uniform(-math.pi, math.pi, (50, 2)):
        found, gradient = query.distance_with_gradient(arm.cobject, q)
        assert found.distance == query.distance(arm.cobject, q).distance and gradient.shape == (2,)
        if found.has_contact:
            near = query.gradients(arm.cobject, q, found.upper, 1)
            assert (gradient == near.gradients[near[0].first_contact]).all()
        else:
            assert (gradient == 0).all()
    assert (query.distance_with_gradient(arm.cobject, q, 0)[1] == 0).all() or arm.clearance(q) <= 0
    with pytest.raises(cstk.WrongSizeError, match="q"):
        query.distance_with_gradient(arm.cobject, [[0, 0]])


def test_a_base_may_stand_on_its_table(query):
    cube = cstk.Body.box([0.5, 0.5, 0.5])
    builder = cstk.RobotBuilder()
    base = builder.add_link(body=cube)
    builder.add_link(body=cube, parent=base, joint=cstk.JointKind.PRISMATIC, at=cstk.translation(0, 0, 2), axis=[1, 0, 0])
    space, world = cstk.Space(builder.build()), cstk.Environment()
    world.add(cube, cstk.translation(0, 0, -1), name="table")
    world.add(cube, cstk.translation(5, 0, 2), name="wall")
    nearest = query.distance(cstk.CObject.induced(space, world, leave_out_unmoved=True), [2.5])
    assert nearest.distance == 1.5 and world.object_name(nearest.witness.s_object) == "wall"
    assert query.distance(cstk.CObject.induced(space, world), [2.5]).distance == 0


def test_answers_print_as_words(arm, query):
    assert str(cstk.Class.INSIDE) == f"{cstk.Class.INSIDE}" == "INSIDE" and f"{cstk.Class.INSIDE:d}" == "2"
    assert repr(query.explain(arm.cobject, [0, 0])).startswith("<cstk.Explanation: ")
    assert repr(query.pseudo_normal(arm.cobject, [0, 0], 1)).startswith("<cstk.PseudoNormal: ")
    assert repr(query.signed_distances(arm.cobject, [0, 0], 9)) == "<cstk.SignedDistanceList of 2 pairs>"
    assert repr(query.find_link_pairs(arm.space)).endswith(" to test>")
    cube = cstk.Body.box([0.5, 0.5, 0.5])
    overlap = query.pair_penetration(cube, cstk.identity(), cube, cstk.translation(0.5, 0, 0))
    assert repr(overlap) == "<cstk.PenetrationList of 1>"
    witness = query.witnesses(arm.cobject, [0, 0], 9)[0]
    assert witness.r_part is None and witness.s_part is None
