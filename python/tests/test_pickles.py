"""Answers go from process to process, and through copies."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import cstk
from cstk import _record


def again(value):
    return pickle.loads(pickle.dumps(value))


def test_answers(arm, query):
    q = np.array([[1.2, 0.1], [-1.0, 0.0], [np.nan, 0]])
    distance = query.distance(arm.cobject, q[0])
    found = again(distance)
    assert distance.witness.s_data == "the disc" and found.witness.s_data is None
    assert found.distance == distance.distance and found.witness.s_object == arm.object
    assert found.r_point.tolist() == distance.r_point.tolist()
    # Part of an answer.
    witness = again(distance.witness)
    assert type(witness) is cstk.Witness and witness.distance == distance.witness.distance
    motion = query.motion(arm.cobject, q[0], q[1])
    moved = again(motion)
    assert type(moved) is cstk.Motion and moved.outcome == motion.outcome and bool(moved) == bool(motion)
    assert moved.times == pytest.approx(motion.times) and moved.reached.tolist() == motion.reached.tolist()


def test_batches(arm):
    q = np.array([[1.2, 0.1], [-1.0, 0.0], [np.nan, 0]])
    batch = cstk.Batch(threads=1)
    classes = again(batch.classify(arm.cobject, q))
    assert classes.classes.tolist()[2] == -1 and classes.result.failed == 1 and classes.answered.tolist() == [True, True, False]
    assert isinstance(classes.failure, cstk.NotFiniteError) and classes.failure.status == cstk.NotFiniteError.status
    distances = batch.distance(arm.cobject, q[:2], results=True, space=arm.space)
    found = again(distances)
    assert found.distances.tolist() == distances.distances.tolist() and found.gradients.tolist() == distances.gradients.tolist()
    assert [each.distance for each in found.results] == distances.distances.tolist() and found.results[0].witness.s_data is None
    motions = batch.motion(arm.cobject, q[:1], q[1:2])
    assert again(motions).free.tolist() == motions.free.tolist() and again(motions).results[0].outcome == motions.results[0].outcome
    none = batch.motion(arm.cobject, q[:0], q[:0])
    assert len(again(none)) == 0 and len(again(none).results) == 0
    with pytest.raises(cstk.CancelledError) as ended:
        batch.classify(arm.cobject, q, progress=lambda part: False)
    assert len(again(ended.value).answers) == 3


def test_another_process(arm, query, tmp_path):
    (tmp_path / "answer").write_bytes(pickle.dumps(query.distance(arm.cobject, [1.2, 0.1])))
    program = f"import pickle, cstk; print(pickle.load(open({str(tmp_path / 'answer')!r}, 'rb')).distance)"
    told = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    assert float(told.stdout) == pytest.approx(arm.clearance([1.2, 0.1]), abs=1e-12)


def test_no_pointer_leaves_the_process(arm, query):
    """The number behind the data is no address, but would name other data there."""
    contents = query.distance(arm.cobject, [1.2, 0.1]).__reduce__()[1][3]
    array = np.frombuffer(contents, _record.dtype_of("cstk_distance_result"))
    assert array["witness"]["s_data"][0] == 0 and array["witness"]["s_object"][0] == arm.object


def test_copies_keep_data(arm, query):
    distance = query.distance(arm.cobject, [1.2, 0.1])
    motion = query.motion(arm.cobject, [1.2, 0.1], [-1, 0])
    results = cstk.Batch().distance(arm.cobject, [[1.2, 0.1]], results=True)
    for copied in copy.copy, copy.deepcopy:
        assert copied(distance).witness.s_data == "the disc"
        assert copied(results).results[0].witness.s_data == "the disc"
    deep = copy.deepcopy(motion)
    deep.reached[:] = 7
    assert motion.reached[0] != 7


def test_what_does_not_fit_is_refused(arm, query):
    made, (kind, ctype, size, contents, more) = query.motion(arm.cobject, [1.2, 0.1], [-1, 0]).__reduce__()
    for wrong in ("cstk_witness", size, contents), (ctype, size + 8, contents), (ctype, size, contents[:-1]), (ctype, size, 2 * contents):
        with pytest.raises(cstk.ParseError, match="Motion"):
            made(kind, *wrong, more)
    witnesses = query.witnesses(arm.cobject, [1.2, 0.1], 9)
    with pytest.raises(TypeError, match="cstk.WitnessList cannot be pickled"):
        pickle.dumps(witnesses)
    assert len(again(witnesses.contacts)) == len(witnesses.contacts) > 0
