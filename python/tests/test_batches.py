"""Batches against single calls, and maps against a grid of single calls."""

import numpy as np
import pytest
from conftest import PlanarArm, random_pose

import cstk


def test_batches_equal_single_calls(query, rng):
    arm, batch = PlanarArm(2.2), cstk.Batch()
    q = rng.uniform(-3, 3, (500, 2))
    for threads in 1, 2:
        classes = batch.classify_batch(arm.cobject, q, threads=threads)
        assert classes.values.tolist() == [query.classify(arm.cobject, row) for row in q]
        assert not classes.statuses.any() and classes.done.answered == len(classes) == 500 and classes.error is None
        within = batch.within_batch(arm.cobject, q, 0.5, threads=threads)
        assert within.values.tolist() == [query.within(arm.cobject, row, 0.5) for row in q]
        found = batch.distance_batch(arm.cobject, q, nv=2, whole=True, threads=threads)
        single = [query.distance(arm.cobject, row) for row in q]
        np.testing.assert_array_equal(found.values, [answer.distance for answer in single])
        np.testing.assert_array_equal(found.results["r_point"], [answer.r_point for answer in single])
        assert found.gradients.shape == (500, 2)
    assert batch.statistics(reset=True).primitive_pairs > 0 and batch.statistics().primitive_pairs == 0


def test_motions_and_pairs(query, rng):
    arm, batch = PlanarArm(2.2), cstk.Batch()
    path = rng.uniform(-1, 2, (40, 2))
    found = batch.motion_batch(arm.cobject, path[:-1], path[1:])
    single = [query.motion(arm.cobject, a, b) for a, b in zip(path[:-1], path[1:])]
    assert found.values.tolist() == [motion.outcome for motion in single]
    np.testing.assert_array_equal(found.reached, [motion.reached for motion in single])
    np.testing.assert_array_equal(found.results["times"], [motion.times for motion in single])
    a, b = cstk.Body.box([1, 2, 3]), cstk.Body.sphere(0.5)
    places = np.array([random_pose(rng, 4) for _ in range(100)])
    still = np.tile(np.eye(4), (100, 1, 1))
    apart = batch.pair_distance_batch(a, still, b, places, whole=True)
    np.testing.assert_array_equal(apart.values, [query.pair_distance(a, np.eye(4), b, place).distance for place in places])
    near = batch.pair_within_batch(a, still, b, places[:, :3], 1.0)
    assert near.values.tolist() == [query.pair_within(a, np.eye(4), b, place, 1.0) for place in places]


def test_items_fail_alone_and_hits_end_a_batch(rng):
    arm, batch = PlanarArm(2.2), cstk.Batch()
    q = np.zeros((20, 2))
    q[7, 1] = np.nan
    q[12] = 1.57, 0
    found = batch.classify_batch(arm.cobject, q)
    assert found.done.failed == 1 and found.done.first_failed == 7 and isinstance(found.error, cstk.NotFiniteError)
    assert found.values[12] == cstk.Class.INSIDE
    stopped = batch.classify_batch(arm.cobject, q, stop_at_hit=True)
    assert stopped.done.has_hit and stopped.done.first_hit == 12
    assert len(batch.classify_batch(arm.cobject, np.empty((0, 2)))) == 0
    with pytest.raises(cstk.WrongSizeError, match="q has shape"):
        batch.classify_batch(arm.cobject, [0.0, 0.0])
    with pytest.raises(cstk.WrongSizeError, match="q0.*q1"):
        batch.motion_batch(arm.cobject, q, q[1:])
    with pytest.raises(cstk.CancelledError):
        batch.classify_batch(arm.cobject, rng.uniform(-3, 3, (100000, 2)), progress=lambda part: False)


@pytest.mark.parametrize("kind", cstk.MapKind)
def test_maps_equal_a_grid(query, tmp_path, kind):
    arm = PlanarArm(2.2)
    axes = [cstk.MapAxis(0, 0, 3, 24), cstk.MapAxis(1, -1, 1, 16)]
    found = cstk.Map.build(arm.cobject, [0, 0], axes, kind, threads=1)
    assert found.kind == kind and found.axes == axes and found.values.shape == (24, 16)
    middles = np.array([[[a, b] for b in axes[1].middles()] for a in axes[0].middles()])
    for cell, value in zip(middles.reshape(-1, 2), found.values.ravel()):
        if kind == cstk.MapKind.CLASSES:
            assert value == query.classify(arm.cobject, cell)
        elif kind == cstk.MapKind.DISTANCES:
            assert value == query.distance(arm.cobject, cell).distance
        else:
            assert (value != cstk.RegionOutcome.FREE) or arm.clearance(cell) > 0
    found.save(tmp_path / "map.npy")
    np.testing.assert_array_equal(np.load(tmp_path / "map.npy"), found.values)
    found.show(tmp_path / "map.png")
    assert (tmp_path / "map.png").read_bytes()[1:4] == b"PNG" and found.proofs + found.questions > 0
