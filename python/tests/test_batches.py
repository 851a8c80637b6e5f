"""Batches against single calls, bit for bit, and what becomes of items without an answer."""

import numpy as np
import pytest
from conftest import PlanarArm, random_pose

import cstk
from cstk._native import ffi

NAN = float("nan")
COUNT = 300
CANCELLED = cstk.CancelledError.status


@pytest.fixture(scope="module")
def arm():
    return PlanarArm(2.2)


@pytest.fixture(scope="module")
def q(arm):
    """Configurations of which some hit the disc, none of the first three."""
    q = np.random.default_rng(2).uniform(-1, 3, (COUNT, 2))
    q[:3] = [[-0.5, 0], [0, 0.2], [0.1, -0.3]]
    hits = [arm.clearance(one) <= 0 for one in q]
    assert COUNT / 50 < sum(hits) < COUNT / 2 and not any(hits[:3])
    return q


@pytest.fixture(params=[1, 2, 5])
def batch(request):
    return cstk.Batch(threads=request.param)


@pytest.fixture
def cubes(rng):
    """Two bodies and poses, some of which let them meet."""
    bodies = cstk.Body.box([0.5, 0.4, 0.3]), cstk.Body.box([0.3, 0.3, 0.6])
    poses = np.array([[random_pose(rng, 1)[:3] for _ in range(COUNT)] for _ in range(2)])
    return bodies[0], poses[0], bodies[1], poses[1]


def all_same(singles, records):
    """The fields of single answers and of those in an array, to the last bit."""
    assert len(singles) == len(records) == len(records.array)
    for i, single in enumerate(singles):
        assert same_fields(np.frombuffer(ffi.buffer(single._c), records.array.dtype)[0], records.array[i])


def same_fields(a, b):
    if a.dtype.names:
        return all(same_fields(a[name], b[name]) for name in a.dtype.names)
    return np.asarray(a).tobytes() == np.asarray(b).tobytes()


def first(hits):
    return int(np.argmax(hits))


def test_classes(arm, query, batch, q):
    found = batch.classify(arm.cobject, q)
    assert found.classes.tolist() == [query.classify(arm.cobject, one) for one in q]
    assert ((found.classes == cstk.Class.INSIDE) == [arm.clearance(one) <= 0 for one in q]).all()
    assert len(found) == COUNT and found.answered.all() and found.failure is None and found.first_hit is None
    assert found.result.answered == COUNT and found.result.failed == 0 and found.result.first_failed is None
    assert found.result.environment_version == query.version(arm.environment)
    found.check()
    assert repr(found) == f"<cstk.BatchClasses: {COUNT} of {COUNT} items answered>"


def test_within(arm, query, batch, q):
    found = batch.within(arm.cobject, q, 0.3)
    assert found.within.dtype == bool and found.within.tolist() == [query.within(arm.cobject, one, 0.3) for one in q]


def test_distances_and_gradients(arm, query, batch, q):
    singles = [query.distance(arm.cobject, one, 0.8) for one in q]
    alone = batch.distance(arm.cobject, q, 0.8)
    assert alone.results is None and alone.gradients is None
    found = batch.distance(arm.cobject, q, 0.8, results=True, space=arm.space)
    expected = np.array([single.distance for single in singles])
    assert found.distances.tobytes() == alone.distances.tobytes() == expected.tobytes()
    all_same(singles, found.results)
    assert found.gradients.shape == (COUNT, 2)
    asked = 0
    for i, single in enumerate(singles):
        if single.contact is None:
            assert not found.gradients[i].any()
        elif 0.01 < single.distance:
            step = 1e-6 * np.eye(2)
            truth = [(arm.clearance(q[i] + e) - arm.clearance(q[i] - e)) / 2e-6 for e in step]
            asked += np.abs(found.gradients[i] - truth).max() <= 1e-6
    assert asked > COUNT / 4


def test_motions(arm, query, batch, q):
    singles = [query.motion(arm.cobject, a, b, threshold=0.01) for a, b in zip(q[:-1], q[1:])]
    found = batch.motion(arm.cobject, q[:-1], q[1:], threshold=0.01)
    all_same(singles, found.results)
    assert found.reached.tobytes() == np.array([single.reached for single in singles]).tobytes()
    assert found.free.tolist() == [bool(single) for single in singles] and 5 < found.free.sum() < COUNT - 5
    coarse = batch.motion(arm.cobject, q[:-1], q[1:], any_contact=True, tolerance=1e-2)
    assert found.results.array["has_distance"].any() and not coarse.results.array["has_distance"].any()


def test_pairs(query, batch, cubes):
    a, at_a, b, at_b = cubes
    pairs = list(zip(at_a, at_b))
    singles = [query.pair_distance(a, one, b, other) for one, other in pairs]
    found = batch.pair_distance(*cubes, results=True)
    assert found.distances.tobytes() == np.array([single.distance for single in singles]).tobytes()
    all_same(singles, found.results)
    assert batch.pair_distance(*cubes).results is None
    meet = batch.pair_within(*cubes).within
    assert meet.tolist() == [query.pair_within(a, one, b, other) for one, other in pairs]
    assert (meet == (found.distances == 0)).all() and 5 < meet.sum() < COUNT - 5
    near = batch.pair_within(*cubes, 0.2).within
    assert near.tolist() == [query.pair_within(a, one, b, other, 0.2) for one, other in pairs]
    full = np.tile(np.eye(4), (2, COUNT, 1, 1))
    full[0, :, :3], full[1, :, :3] = at_a, at_b
    assert (batch.pair_within(a, full[0], b, full[1]).within == meet).all()


def test_the_first_hit(arm, batch, q, cubes):
    meet = batch.pair_within(*cubes).within
    inside = batch.classify(arm.cobject, q).classes == cstk.Class.INSIDE
    stopped = [
        (batch.classify(arm.cobject, q, stop_at_hit=True), inside),
        (batch.within(arm.cobject, q, 0.1, stop_at_hit=True), batch.within(arm.cobject, q, 0.1).within),
        (batch.distance(arm.cobject, q, results=True, space=arm.space, stop_at_hit=True), inside),
        (batch.motion(arm.cobject, q, q[::-1].copy(), stop_at_hit=True), ~batch.motion(arm.cobject, q, q[::-1]).free),
        (batch.pair_within(*cubes, stop_at_hit=True), meet),
        (batch.pair_distance(*cubes, stop_at_hit=True, results=True), meet),
    ]
    for found, hits in stopped:
        hit = first(hits)
        assert found.first_hit == hit == found.result.first_hit and hit < COUNT - 1
        assert found.statuses.tolist() == [0] * (hit + 1) + [CANCELLED] * (COUNT - hit - 1)
        assert found.failure is None and found.result.answered == hit + 1
    classes, within, distances, motions, meets, apart = (found for found, _ in stopped)
    after = first(inside) + 1
    assert (classes.classes[after:] == -1).all() and (classes.classes[:after] >= 0).all()
    assert within.within[within.first_hit + 1 :].all() and meets.within[meets.first_hit + 1 :].all()
    assert np.isnan(distances.distances[after:]).all() and np.isnan(distances.gradients[after:]).all()
    assert not np.isnan(distances.distances[:after]).any() and not np.isnan(distances.gradients[:after]).any()
    assert np.isnan(distances.results.array["distance"][after:]).all() and distances.results[after].witness is None
    assert np.isnan(apart.results.array["distance"][apart.first_hit + 1 :]).all()
    after = motions.first_hit + 1
    assert not motions.free[after:].any() and np.isnan(motions.reached[after:]).all()
    with pytest.raises(ValueError):
        motions.results[after].outcome


def test_an_item_that_fails_fails_alone(arm, batch, q, cubes):
    k = 217
    bad = q.copy()
    bad[k, 1] = NAN
    poses = cubes[1].copy()
    poses[k, 0, 0] = 7
    others = np.arange(COUNT) != k
    for ask in (
        lambda q, poses: batch.classify(arm.cobject, q).classes,
        lambda q, poses: batch.within(arm.cobject, q, 0.1).within,
        lambda q, poses: batch.distance(arm.cobject, q, space=arm.space).gradients,
        lambda q, poses: batch.motion(arm.cobject, q, q).reached,
        lambda q, poses: batch.pair_distance(cubes[0], poses, *cubes[2:]).distances,
        lambda q, poses: batch.pair_within(cubes[0], poses, *cubes[2:]).within,
    ):
        assert ask(bad, poses)[others].tobytes() == ask(q, cubes[1])[others].tobytes()
    found = batch.classify(arm.cobject, bad)
    assert found.result.failed == 1 and found.result.first_failed == k and found.answered.tolist() == others.tolist()
    assert found.classes[k] == -1 and found.statuses[k] == cstk.NotFiniteError.status
    with pytest.raises(cstk.NotFiniteError, match=f"item {k}: configuration entry 1"):
        found.check()
    moved = batch.motion(arm.cobject, q, bad)
    assert not moved.free[k] and np.isnan(moved.reached[k]).all() and isinstance(moved.failure, cstk.NotFiniteError)
    within = batch.pair_within(cubes[0], poses, *cubes[2:])
    assert within.within[k] and isinstance(within.failure, cstk.NotARotationError)
    assert batch.classify(arm.cobject, q).failure is None


def test_progress_hears_and_ends(arm, batch, q):
    many = np.tile(q, (40, 1))
    heard = []
    whole = batch.classify(arm.cobject, many, progress=heard.append)
    assert whole.answered.all() and heard == sorted(heard) and 0 <= heard[0] and heard[-1] <= 1

    with pytest.raises(cstk.CancelledError) as ended:
        batch.classify(arm.cobject, many, progress=lambda part: False)
    answers = ended.value.answers
    assert isinstance(answers, cstk.BatchClasses) and answers.result is None and not answers.answered.all()
    assert set(answers.statuses[~answers.answered]) == {CANCELLED}
    assert (answers.classes[answers.answered] == whole.classes[answers.answered]).all()
    assert (answers.classes[~answers.answered] == -1).all()

    with pytest.raises(ZeroDivisionError):
        batch.motion(arm.cobject, q, q, progress=lambda part: 1 / 0)
    assert batch.classify(arm.cobject, q).answered.all()
    with pytest.raises(cstk.CancelledError) as single:
        cstk.Query().motion_path(arm.cobject, q[:3], progress=lambda part: False)
    assert single.value.answers is None


def test_what_a_function_raises_is_the_cause(arm):
    def fails(q):
        if q[0] == 5:
            raise KeyError("five")
        return cstk.Class.OUTSIDE

    cobject = cstk.CObject.predicate(arm.space, fails)
    q = np.zeros((10, 2))
    q[7, 0] = 5
    found = cstk.Batch(threads=1).classify(cobject, q)
    assert found.result.first_failed == 7 and found.result.failed == 1
    assert isinstance(found.failure, cstk.CallbackFailedError) and isinstance(found.failure.__cause__, KeyError)
    threaded = cstk.Batch(threads=4).classify(cobject, np.tile(q, (100, 1)))
    assert threaded.result.failed == 100 and threaded.result.first_failed == 7
    assert cstk.Batch().classify(cobject, q[:7]).answered.all()


def test_limits_fail_their_items(arm, q):
    batch = cstk.Batch(limit=1)
    found = batch.distance(arm.cobject, q)
    query = cstk.Query()
    query.set_limit(1)
    failed = 0
    for i, one in enumerate(q):
        try:
            assert query.distance(arm.cobject, one).distance == found.distances[i]
        except cstk.LimitError:
            assert found.statuses[i] == cstk.LimitError.status
            failed += 1
    assert found.result.failed == failed > 0 and isinstance(found.failure, cstk.LimitError)
    batch.limit = None
    assert batch.distance(arm.cobject, q).answered.all()


def test_statistics_count_and_begin_anew(arm, q):
    batch = cstk.Batch(threads=1)
    counts = {name: getattr(batch.statistics(), name) for name in cstk.QueryStatistics._fields}
    assert len(counts) >= 4 and not any(counts.values())
    batch.distance(arm.cobject, q)
    assert batch.statistics(reset=True).primitive_distances >= COUNT / 2
    assert batch.statistics().primitive_distances == 0


def test_batches_without_items(arm, batch, cubes):
    none, no_poses = np.empty((0, 2)), np.empty((0, 3, 4))
    for found in (
        batch.classify(arm.cobject, none),
        batch.within(arm.cobject, none, 1),
        batch.distance(arm.cobject, none, results=True, space=arm.space),
        batch.motion(arm.cobject, none, none),
        batch.pair_within(cubes[0], no_poses, cubes[2], no_poses),
        batch.pair_distance(cubes[0], no_poses, cubes[2], no_poses, results=True),
    ):
        assert len(found) == 0 and found.result.answered == 0 and found.failure is None


def test_arrays_are_not_copied_nor_changed(arm, q):
    tracemalloc = pytest.importorskip("tracemalloc", reason="PyPy does not count what is allocated")
    batch, many = cstk.Batch(threads=1), np.tile(q, (300, 1))
    kept = many.copy()
    batch.classify(arm.cobject, many)
    tracemalloc.start()
    batch.classify(arm.cobject, many)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    # Classes, statuses and which were answered: 9 bytes an item; a copy of q would add 16.
    assert peak < 10 * len(many) and many.tobytes() == kept.tobytes()
    many.flags.writeable = False
    assert batch.classify(arm.cobject, many).answered.all()


def test_arrays_of_all_kinds_are_taken(arm, q):
    batch = cstk.Batch()
    whole = np.round(q)
    expected = batch.classify(arm.cobject, whole).classes.tolist()
    kinds = whole.tolist(), whole.astype(np.float32), whole.astype(int), np.asfortranarray(whole), np.repeat(whole, 2, 0)[::2]
    for other in kinds:
        assert batch.classify(arm.cobject, other).classes.tolist() == expected


CASES = [
    ("batch.classify(cobject, [0, 0])", cstk.WrongSizeError, r"q has shape \(2,\)"),
    ("batch.classify(cobject, np.zeros((1, 2, 2)))", cstk.WrongSizeError, "q has shape"),
    ("batch.classify(cobject, np.zeros((4, 3)))", cstk.WrongSizeError, "nq is 3"),
    ("batch.classify(cobject, [[0, 0], [0]])", cstk.WrongSizeError, "q is no array"),
    ("batch.classify(cobject, np.zeros((4, 2), bool))", TypeError, "q holds bool"),
    ("batch.classify(cobject, np.zeros((4, 2), complex))", TypeError, "q holds complex128"),
    ("batch.classify(cobject, [[None, 1]])", TypeError, "q holds object"),
    ("batch.classify(None, q)", TypeError, "cobject must be a cstk.CObject"),
    ("batch.classify(cobject, q, progress=3)", TypeError, "progress must be a function"),
    ("batch.within(cobject, q, -1)", cstk.InvalidArgumentError, "threshold"),
    ("batch.within(cobject, q, NAN)", cstk.Error, "threshold"),
    ("batch.within(cobject, q, 'far')", TypeError, "threshold"),
    ("batch.distance(cobject, q, NAN)", cstk.Error, "max_distance"),
    ("batch.distance(cobject, q, space=cobject)", TypeError, "space must be a cstk.Space"),
    ("batch.motion(cobject, q, q[:-1])", cstk.WrongSizeError, "q0 has shape.*q1"),
    ("batch.motion(cobject, q, q, tolerance=-1)", cstk.Error, "tolerance"),
    ("batch.pair_within(body, poses, body, poses[:1])", cstk.WrongSizeError, "poses_a has shape.*poses_b"),
    ("batch.pair_within(body, np.eye(4), body, poses)", cstk.WrongSizeError, "poses_a has shape"),
    ("batch.pair_within(body, np.ones((2, 4, 4)), body, poses)", cstk.InvalidArgumentError, "poses_a: the last row"),
    ("batch.pair_distance(body, poses, None, poses)", TypeError, "body_b must be a cstk.Body"),
    ("batch.pair_distance(body, poses, body, poses, NAN)", cstk.Error, "max_distance"),
    ("cstk.Batch(threads=-1)", cstk.InvalidArgumentError, "threads"),
    ("cstk.Batch(threads=1.5)", TypeError, "threads"),
    ("cstk.Batch(limit='much')", TypeError, "limit"),
    ("cstk.Batch(threads=1025).classify(cobject, q)", cstk.InvalidArgumentError, "threads"),
]


@pytest.mark.parametrize("call, kind, says", CASES)
def test_the_culprit_is_named(arm, q, call, kind, says):
    names = {"cstk": cstk, "np": np, "NAN": NAN, "batch": cstk.Batch(), "cobject": arm.cobject, "q": q}
    names["body"], names["poses"] = cstk.Body.sphere(1), np.tile(np.eye(4), (2, 1, 1))
    with pytest.raises(kind, match=says):
        eval(call, names)


def test_release_and_busy(arm, q):
    with cstk.Batch() as batch:
        batch.classify(arm.cobject, q)
    with pytest.raises(cstk.ReleasedError, match="the Batch was released"):
        batch.classify(arm.cobject, q)
    batch = cstk.Batch(threads=1)
    raised = []

    def asks(one):
        with pytest.raises(cstk.BusyError):
            batch.classify(arm.cobject, q)
        raised.append(one)
        return cstk.Class.OUTSIDE

    assert batch.classify(cstk.CObject.predicate(arm.space, asks), q[:3]).answered.all() and len(raised) == 3
