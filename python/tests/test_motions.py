"""Motions, certificates, regions and slides against closed forms of the planar arm."""

import math
import pickle

import numpy as np
import pytest
from conftest import PlanarArm

import cstk


def first_touch(arm, q0, q1):
    """The first time of contact on a straight motion, by a fine scan and bisection of the closed form."""
    q0, q1 = np.asarray(q0, float), np.asarray(q1, float)
    times = np.linspace(0, 1, 4001)
    inside = arm.clearance(q0 + np.outer(times, q1 - q0)) <= 0
    if not inside.any():
        return None
    end = int(np.argmax(inside))
    low, high = times[max(end - 1, 0)], times[end]
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if arm.clearance(q0 + middle * (q1 - q0)) <= 0 else (middle, high)
    return high


def test_motions_end_where_the_closed_form_does(query, rng):
    arm = PlanarArm(2.2)
    outcomes = set()
    for _ in range(60):
        q0, q1 = rng.uniform(-1, 3, (2, 2))
        if arm.clearance(q0) <= 0.01 or abs(q1 - q0).max() > 3:
            continue
        truth, found = first_touch(arm, q0, q1), query.motion(arm.cobject, q0, q1)
        outcomes.add(found.outcome)
        if truth is None:
            assert found or found.outcome == cstk.MotionOutcome.NEAR
        else:
            assert found.outcome == cstk.MotionOutcome.HIT
            assert found.times[1] == pytest.approx(truth, abs=3e-6)
            np.testing.assert_allclose(found.reached, q0 + found.times[1] * (q1 - q0), atol=1e-12)
            assert found.distance.distance <= 1e-5
    assert {cstk.MotionOutcome.FREE, cstk.MotionOutcome.HIT} <= outcomes


def test_paths_curves_and_splines(query):
    arm = PlanarArm(2.2)
    free, hit = [0.0, 0.0], [1.6, 0.0]
    path = query.motion_path(arm.cobject, [[-1, 0], free, hit, [2, 2]])
    assert path.segment == 1 and path.motion.outcome == cstk.MotionOutcome.HIT and not path
    assert path.motion.times[1] == pytest.approx(first_touch(arm, free, hit), abs=3e-6)
    np.testing.assert_allclose(path.reached, np.array(hit) * path.motion.times[1], atol=1e-12)
    assert query.motion_path(arm.cobject, [[-1, 0], free])
    line = np.linspace(free, hit, 4)
    for found in (
        query.motion_curve(arm.cobject, line),
        query.motion_spline(arm.cobject, 1, [0, 0, 1, 1], [free, hit]),
        query.motion_spline(arm.cobject, 3, [0, 0, 0, 0, 1, 1, 1, 1], line),
    ):
        assert found.times[1] == pytest.approx(path.motion.times[1], abs=3e-6)
    assert query.motion(arm.cobject, free, hit, any_contact=True).distance is None
    heard = []
    query.motion_path(arm.cobject, [[-1, 0], free], progress=heard.append)
    assert heard
    with pytest.raises(cstk.CancelledError):
        query.motion_path(arm.cobject, [[-1, 0], free], progress=lambda part: False)


def test_motions_of_functions(query):
    arm = PlanarArm(2.2)

    def swing(t):
        angle, rate, bend = 1.6 * math.sin(t), 1.6 * math.cos(t), -1.6 * math.sin(t)
        return [angle, 0], [rate, 0], [bend, 0]

    found = query.motion_function(arm.cobject, swing, [1.6, 0], [1.6, 0])
    straight = query.motion(arm.cobject, [0, 0], [1.6, 0])
    assert found.outcome == cstk.MotionOutcome.HIT
    assert found.times[1] == pytest.approx(math.asin(straight.times[1]), abs=5e-6)
    assert query.motion_function(arm.cobject, swing, [1.6, 0], [1.6, 0], any_contact=True).distance is None
    with pytest.raises(cstk.InvalidArgumentError):
        query.motion_function(arm.cobject, swing, [0.1, 0], [1.6, 0])
    with pytest.raises(ZeroDivisionError):
        query.motion_function(arm.cobject, lambda t: 1 / 0, [1, 1], [1, 1])
    with pytest.raises(cstk.WrongSizeError, match="rates"):
        query.motion_function(arm.cobject, lambda t: ([0, 0], [0], [0, 0]), [1, 1], [1, 1])
    with pytest.raises(cstk.WrongSizeError, match="max_rates.*max_accelerations"):
        query.motion_function(arm.cobject, swing, [1, 1], [1])


def test_clearance_of_a_sweep(arm, query):
    # The straight arm sweeps past the disc: nearest where it points at it.
    found = query.motion_clearance(arm.cobject, [0.5, 0], [2.5, 0], 1e-6)
    truth = 3 - 2 - 0.1 - 0.5
    assert found.outcome == cstk.ClearanceOutcome.KNOWN
    assert found.lower <= truth <= found.upper and found.upper - found.lower <= 1e-6
    assert found.nearest[0] == pytest.approx(math.pi / 2, abs=2e-3)
    beyond = query.motion_clearance(arm.cobject, [0.5, 0], [2.5, 0], 1e-3, max_distance=0.25)
    assert beyond.outcome == cstk.ClearanceOutcome.BEYOND_MAX


def test_the_clearance_of_a_path_is_that_of_its_nearest_segment(arm, query):
    points = [[-1, 0], [0.5, 0], [2.5, 0], [3.0, 0.2]]
    found = query.path_clearance(arm.cobject, points, 1e-6)
    truth = 3 - 2 - 0.1 - 0.5
    assert found.segment == 1 and found.clearance.outcome == cstk.ClearanceOutcome.KNOWN
    assert found.clearance.lower <= truth <= found.clearance.upper
    assert found.nearest[0] == pytest.approx(math.pi / 2, abs=2e-3)
    # No sample is nearer.
    for a, b in zip(np.array(points), np.array(points[1:])):
        assert min(arm.clearance(a + t * (b - a)) for t in np.linspace(0, 1, 50)) >= found.clearance.lower
    heard = []
    query.path_clearance(arm.cobject, points, 1e-3, progress=heard.append)
    assert heard[-1] == 1 and heard == sorted(heard)
    with pytest.raises(cstk.CancelledError):
        query.path_clearance(arm.cobject, points, 1e-3, progress=lambda part: False)


def test_shortcuts_are_shorter_and_free(query):
    arm = PlanarArm(2.2)
    points = [[0.0, 0.0], [0.0, 1.0], [0.3, 2.2], [1.2, 2.6], [2.0, 2.0], [3.0, 0.0]]
    assert query.motion_path(arm.cobject, points) and not query.motion(arm.cobject, points[0], points[-1])
    found = query.path_shortcut(arm.cobject, points, attempts=200, seed=3)
    assert found.outcome == cstk.ShortcutOutcome.DONE and found.cuts > 0
    lengths = [np.linalg.norm(np.diff(path, axis=0), axis=1).sum() for path in (np.array(points), found.path)]
    assert [found.length_before, found.length_after] == pytest.approx(lengths) and lengths[1] < 0.99 * lengths[0]
    np.testing.assert_array_equal(found.path[[0, -1]], [points[0], points[-1]])
    for a, b in zip(found.path, found.path[1:]):
        assert query.motion(arm.cobject, a, b)
        assert min(arm.clearance(a + t * (b - a)) for t in np.linspace(0, 1, 50)) > 0
    again = query.path_shortcut(arm.cobject, points, attempts=200, seed=3)
    np.testing.assert_array_equal(again.path, found.path)
    blocked = query.path_shortcut(arm.cobject, [[0, 0], [1.6, 0], [3, 0]])
    assert blocked.outcome == cstk.ShortcutOutcome.NOT_FREE and blocked.given.segment in (0, 1)
    with pytest.raises(cstk.CancelledError):
        query.path_shortcut(arm.cobject, points, progress=lambda part: False)


def test_certificates_prove_and_are_kept(arm, query, tmp_path):
    q0, q1 = [0.5, 0], [2.5, 0]
    motion, certificate = query.motion_certificate(arm.cobject, q0, q1, threshold=0.1)
    assert motion
    certificate.verify(arm.cobject, q0, q1, 0.1)
    with pytest.raises(cstk.NotProvedError):
        certificate.verify(arm.cobject, q0, [2.6, 0], 0.1)
    certificate.save(tmp_path / "proof")
    for other in cstk.Certificate.load(tmp_path / "proof"), pickle.loads(pickle.dumps(certificate)):
        other.verify(arm.cobject, q0, q1, 0.1)
        assert other.summary().fingerprint == certificate.summary().fingerprint
        assert len(other.summary().fingerprint) == 32 and other.summary().threshold == 0.1
        np.testing.assert_array_equal(other.ends(), [q0, q1])
    entry = certificate.entry(0)
    assert entry.gap - entry.displacement > 0.1 and np.linalg.norm(entry.direction) == pytest.approx(1)
    assert entry.links[1] is None and len(certificate.primitives(0, 0)) == entry.primitive_counts[0]
    hit, none = query.motion_certificate(PlanarArm(2.2).cobject, [0, 0], [1.6, 0])
    assert hit.outcome == cstk.MotionOutcome.HIT and none is None


def test_regions_against_a_grid(query):
    arm = PlanarArm(2.2)

    def grid(low, high):
        axes = [np.linspace(low[i], high[i], 25) for i in range(2)]
        return [arm.clearance([a, b]) <= 0 for a in axes[0] for b in axes[1]]

    free = query.region_classify(arm.cobject, [-1, -1], [0, 1])
    assert free.outcome == cstk.RegionOutcome.FREE and free.inside is None and not any(grid([-1, -1], [0, 1]))
    mixed = query.region_classify(arm.cobject, [0, -1], [2, 1])
    assert mixed.outcome == cstk.RegionOutcome.MIXED
    assert arm.clearance(mixed.inside) <= 0 < arm.clearance(mixed.outside)
    inside = query.region_classify(arm.cobject, [1.5, -0.05], [1.6, 0.05])
    assert inside.outcome == cstk.RegionOutcome.INSIDE and all(grid([1.5, -0.05], [1.6, 0.05]))
    grown = query.region_grow(arm.cobject, arm.space, [0.5, 0], max_side=1.5)
    assert not any(grid(grown.low, grown.high)) and (grown.high - grown.low).min() > 0.2
    assert len(grown.sides) == 4
    stops = {side.stop for side in grown.sides}
    assert cstk.SideStop.CONTACT in stops or cstk.SideStop.UNPROVED in stops
    still = query.region_grow(arm.cobject, arm.space, [0.5, 0], weights=[1, 0])
    assert still.low[1] == still.high[1] == 0 and still.sides[2].stop == cstk.SideStop.FIXED


def test_a_slide_keeps_its_distance(query):
    arm = PlanarArm(2.2)
    q, worst, slid = np.array([0.6, 0.0]), math.inf, 0
    for _ in range(40):
        found = query.slide(arm.cobject, q, [0.05, 0.0], max_shell=0.2, desired_distance=0.02, normalize=True)
        if found.outcome != cstk.SlideOutcome.MOVED:
            break
        slid += found.contact_count > 0
        assert query.motion(arm.cobject, q, found.reached).outcome == cstk.MotionOutcome.FREE
        q = found.reached
        worst = min(worst, arm.clearance(q))
        assert found.distance_after == pytest.approx(arm.clearance(q), abs=1e-12)
    assert slid > 5 and worst > 0.01


def test_a_slide_goes_on_until_it_arrives_or_is_stopped(query):
    arm = PlanarArm(2.2)
    free = query.slide_to(arm.cobject, [0.0, 0.0], [0.3, 0.2], 0.05, 0.2)
    assert free and free.path.tolist() == [[0, 0], [0.3, 0.2]] and free.remaining == 0
    # With the elbow free to bend away the first joint comes past the disc.
    past = query.slide_to(
        arm.cobject, [0.6, 0.1], [2.6, -np.inf], 0.05, 0.2, goal_high=[2.7, np.inf], normalize=True, max_idle_steps=20
    )
    assert past.outcome in (cstk.SlideToOutcome.ARRIVED, cstk.SlideToOutcome.IDLE, cstk.SlideToOutcome.BLOCKED)
    assert past.steps > 0 and len(past.path) > 2
    for a, b in zip(past.path, past.path[1:]):
        assert min(arm.clearance(a + t * (b - a)) for t in np.linspace(0, 1, 20)) > 0
    few = query.slide_to(arm.cobject, [0.6, 0.0], [2.6, 0.0], 0.05, 0.2, max_steps=2, weights=[1, 2])
    assert few.outcome == cstk.SlideToOutcome.STEPS and few.steps == 2 and not few
    with pytest.raises(cstk.CancelledError):
        query.slide_to(arm.cobject, [0.6, 0.0], [2.6, 0.0], 0.05, 0.2, progress=lambda part: False)
    with pytest.raises(cstk.WrongSizeError, match="goal"):
        query.slide_to(arm.cobject, [0.6, 0.0], [2.6], 0.05, 0.2)
    with pytest.raises(cstk.InvalidArgumentError, match="step"):
        query.slide_to(arm.cobject, [0.6, 0.0], [2.6, 0.0], 0, 0.2)


def test_the_halves_of_a_slide(query):
    arm = PlanarArm(2.2)
    q = np.array([1.25, 0.0])
    found = query.gradients(arm.cobject, q, 0.5)
    assert len(found.contacts) >= 1
    desired = found[0].distance - 0.01
    step = cstk.slide_step(found, [0.5, 0.0], desired)
    changes = found.contacts.array["distance"] + found.gradients @ step
    assert (changes >= desired - 1e-9).all()
    out = cstk.spring_step(found, found[0].distance + 0.05)
    assert (found.contacts.array["distance"] + found.gradients @ out >= found[0].distance + 0.05 - 1e-9).all()
    assert cstk.spring_step(found, 0.0) is None
    with pytest.raises(cstk.Error):
        cstk.slide_step(query.witnesses(arm.cobject, q, 0.5), [0.5, 0.0], desired)


def test_what_slide_steps_read_cannot_be_taken_away(query):
    arm = PlanarArm(2.2)
    found = query.gradients(arm.cobject, [1.25, 0.0], 0.5)
    desired = found[0].distance - 0.01
    step = cstk.slide_step(found, [0.5, 0.0], desired)
    for name in ("witnesses", "contacts", "gradients"):
        with pytest.raises(AttributeError):
            setattr(found, name, getattr(found, name))
    with pytest.raises(ValueError):
        found.gradients.resize((0, 2), refcheck=False)
    rows = found.gradients
    assert (cstk.slide_step(found, [0.5, 0.0], desired) == step).all()
    # A view outlives its list.
    before = rows.copy()
    del found
    np.empty(10**6).fill(7)
    assert (rows == before).all()


def test_the_callers_word_is_taken_within_its_sets(query):
    arm = PlanarArm(2.2)
    grown = query.region_grow(arm.cobject, arm.space, [-1.0, 0.0])
    free = cstk.CObject.box(arm.space, grown.low, grown.high)
    known = arm.cobject.with_known(free, cstk.Class.OUTSIDE)
    ends = [grown.low + part * (grown.high - grown.low) for part in (0.3, 0.7)]
    query.statistics(reset=True)
    assert query.classify(known, ends[0]) == cstk.Class.OUTSIDE
    assert query.motion(known, *ends) and query.region_classify(known, *ends).outcome == cstk.RegionOutcome.FREE
    assert query.statistics().node_pairs == 0
    assert query.distance(known, ends[0]).distance == pytest.approx(arm.clearance(ends[0]))
    assert query.motion(known, [0, 0], [1.6, 0]).outcome == cstk.MotionOutcome.HIT
    # A wrong word is taken too, but by no certificate.
    blocked = [math.pi / 2, 0.0]
    wrong = arm.cobject.with_known(cstk.CObject.ball(arm.space, blocked, 0.2), cstk.Class.OUTSIDE)
    assert arm.clearance(blocked) < 0 and query.classify(wrong, blocked) == cstk.Class.OUTSIDE
    assert query.motion(wrong, blocked, [math.pi / 2, 0.1])
    assert query.motion_certificate(wrong, blocked, [math.pi / 2, 0.1])[1] is None
    with pytest.raises(cstk.UnsupportedError):
        arm.cobject.with_known(arm.cobject, cstk.Class.INSIDE)
    with pytest.raises(cstk.InvalidArgumentError):
        arm.cobject.with_known(free, cstk.Class.CONTACT)
