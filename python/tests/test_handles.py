"""Objects: released, collected, shared by threads, pickled; and functions that fail."""

import copy
import gc
import os
import pickle
import subprocess
import sys
import tempfile
import threading
import time
import weakref

import numpy as np
import pytest

import cstk
from cstk._user_data import kept_count


def collected():
    for _ in range(3):
        gc.collect()


def test_use_after_release(arm):
    body = cstk.Body.sphere(1)
    with cstk.Query() as query:
        assert not query.released
        with body as same:
            assert same is body
        with pytest.raises(cstk.ReleasedError, match="body_a is a cstk.Body that was released"):
            query.pair_distance(body, cstk.identity(), body, cstk.identity())
    assert query.released and repr(query) == "<cstk.Query (released)>"
    with pytest.raises(cstk.ReleasedError, match="the Query was released"):
        query.classify(arm.cobject, [0, 0])
    with pytest.raises(cstk.WrongHandleError):
        body.statistics()
    with pytest.raises(cstk.ReleasedError):
        body.__enter__()
    query.release()
    for handle in cstk.Environment(), cstk.BodyBuilder(), cstk.RobotBuilder():
        handle.release()
        with pytest.raises(cstk.ReleasedError):
            handle._pointer


def test_parts_live_as_long_as_the_whole(query):
    body, environment = cstk.Body.sphere(0.5), cstk.Environment()
    builder = cstk.RobotBuilder()
    builder.add_link(cstk.JointKind.PRISMATIC, body=body, axis=[1, 0, 0])
    robot = builder.build()
    space = cstk.Space(robot)
    environment.add(body, cstk.translation(5, 0, 0))
    cobject = cstk.CObject.induced(space, environment)
    for part in body, environment, builder, robot, space:
        part.release()
    assert query.distance(cobject, [0]).distance == 4


def test_data_is_dropped_with_its_owner(query):
    class Named:
        pass

    collected()
    before, data = kept_count(), Named()
    gone = weakref.ref(data)
    body = cstk.Body.sphere(1)
    body.set_data(data)
    with pytest.raises(cstk.InvalidArgumentError):
        body.set_data("twice")
    witness = query.pair_distance(body, cstk.identity(), body, cstk.identity()).witness
    assert body.data is witness.r_data is witness.s_data is data
    assert kept_count() == before + 1
    del data
    body.release()
    query.release()
    collected()
    # The witness is a copy, and asks for nothing that is gone.
    assert gone() is None and kept_count() == before and witness.r_data is None


def test_failed_calls_keep_nothing(arm):
    collected()
    before = kept_count()
    environment = cstk.Environment()
    for call in (
        lambda: environment.add(cstk.Body.sphere(1), np.eye(3), data=object()),
        lambda: environment.apply([cstk.Change.add(cstk.Body.sphere(1), data=object()), cstk.Change.delete(9**9)]),
        lambda: cstk.CObject.predicate(arm.space, lambda q: 0, contact_epsilon=-1),
        lambda: cstk.BodyBuilder().add_support(lambda d: [0, 0, float("nan")]),
    ):
        with pytest.raises(cstk.Error):
            call()
    collected()
    assert kept_count() == before


def test_functions_are_kept_while_sets_use_them(arm, query):
    collected()
    before = kept_count()
    cobject = cstk.CObject.predicate(arm.space, lambda q: cstk.Class.INSIDE)
    wider = cobject | cobject
    del cobject
    collected()
    assert kept_count() == before + 1 and query.classify(wider, [0, 0]) == cstk.Class.INSIDE
    del wider
    query.release()
    collected()
    assert kept_count() == before


def test_what_a_function_raises_is_the_cause(arm, query):
    def fails(q):
        raise LookupError("mine")

    cobject = cstk.CObject.predicate(arm.space, fails)
    with pytest.raises(cstk.CallbackFailedError) as raised:
        query.classify(cobject, [0, 0])
    assert isinstance(raised.value.__cause__, LookupError)
    contradicts = cstk.CObject.predicate(arm.space, lambda q: cstk.Class.INSIDE, lambda q: 5.0)
    with pytest.raises(cstk.CallbackFailedError) as raised:
        query.distance(contradicts, [0, 0])
    assert raised.value.__cause__ is None
    wrong = cstk.CObject.predicate(arm.space, lambda q: 0, lambda q: 1.0, lambda q: [1.0])
    with pytest.raises(cstk.CallbackFailedError) as raised:
        query.gradients(wrong, [0, 0], 9)
    assert "gradient has shape (1,)" in str(raised.value.__cause__)


def test_a_support_function_that_fails_later_is_safe(query, monkeypatch):
    broken, seen = [], []
    monkeypatch.setattr(sys, "unraisablehook", lambda told: seen.append(told.exc_type))

    def support(direction):
        if broken:
            raise LookupError("mine")
        return direction

    body = cstk.BodyBuilder().add_support(support).build()
    ball, away = cstk.Body.sphere(1), cstk.translation(2.8, 0, 0)
    assert query.pair_distance(body, cstk.identity(), ball, away).distance == pytest.approx(0.8)
    broken.append(True)
    # The bounding box is counted, never less.
    assert query.pair_distance(body, cstk.identity(), ball, cstk.translation(2.8, 0.1, 0)).distance <= 0.8 + 1e-9
    assert seen and set(seen) == {LookupError}


def test_a_query_serves_one_call_at_a_time(arm):
    query = cstk.Query()
    seen = []

    def asks(q):
        try:
            query.classify(arm.cobject, q)
        except cstk.BusyError as error:
            seen.append(error)
        return cstk.Class.OUTSIDE

    cobject = cstk.CObject.predicate(arm.space, asks)
    assert query.classify(cobject, [0, 0]) == cstk.Class.OUTSIDE and len(seen) == 1


def test_bodies_and_certificates_are_pickled(query, rng):
    body = cstk.Body.mesh(rng.normal(size=(300, 3)), np.arange(300).reshape(-1, 3))
    body.set_data({"name": "cloud"})
    other = pickle.loads(pickle.dumps(body))
    assert other.data == {"name": "cloud"} and other is not body
    ball = cstk.Body.sphere(0.1)
    for _ in range(20):
        pose = cstk.translation(*rng.normal(size=3) * 4)
        a, b = (query.pair_distance(x, cstk.identity(), ball, pose) for x in (body, other))
        assert a.distance == b.distance and (a.r_point == b.r_point).all()
    shared = copy.deepcopy(body)
    body.release()
    assert shared.data == {"name": "cloud"} and copy.copy(shared).statistics().primitive_count == 100
    support = cstk.BodyBuilder().add_support(lambda d: d).build()
    with pytest.raises(cstk.UnsupportedError):
        pickle.dumps(support)
    for handle in query, cstk.Environment():
        with pytest.raises(TypeError, match="cannot be pickled"):
            pickle.dumps(handle)


def test_a_damaged_body_file_is_refused(tmp_path):
    cstk.Body.box([1, 2, 3]).save(tmp_path / "box")
    again = cstk.Body.load(str(tmp_path / "box"))
    np.testing.assert_array_equal(again.statistics().high, [1, 2, 3])
    (tmp_path / "box").write_bytes((tmp_path / "box").read_bytes()[:-1])
    with pytest.raises(cstk.ParseError):
        cstk.Body.load(tmp_path / "box")


def test_calls_let_other_threads_run(rng):
    builder = cstk.BodyBuilder().add_mesh(rng.uniform(-1, 1, (60000, 3)), np.arange(60000).reshape(-1, 3))
    built = []
    thread = threading.Thread(target=lambda: built.append(builder.build()))
    turns = 0
    thread.start()
    while thread.is_alive():
        turns += 1
        time.sleep(0.001)
    thread.join()
    # With the lock held, this thread would not have had a turn before the end.
    assert turns > 10 and built[0].statistics().primitive_count == 20000


def test_threads_share_everything_but_queries(arm):
    expected = [cstk.Query().distance(arm.cobject, [0.01 * i, 0]).distance for i in range(300)]
    answers = {}

    def work(name):
        query = cstk.Query()
        answers[name] = [query.distance(arm.cobject, [0.01 * i, 0]).distance for i in range(300)]

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4 and all(answer == expected for answer in answers.values())


def test_release_while_another_thread_asks(rng):
    for _ in range(20):
        body = cstk.Body.mesh(rng.normal(size=(3000, 3)), np.arange(3000).reshape(-1, 3))
        errors, started = [], threading.Event()

        def work():
            query = cstk.Query()
            started.set()
            try:
                while True:
                    query.pair_distance(body, cstk.identity(), body, cstk.translation(5, 0, 0))
            except cstk.ReleasedError as error:
                errors.append(error)

        thread = threading.Thread(target=work)
        thread.start()
        started.wait()
        time.sleep(0.002)
        body.release()
        thread.join(30)
        assert not thread.is_alive() and len(errors) == 1


def test_the_process_ends_quietly_with_everything_alive():
    program = """
import threading, cstk
body = cstk.Body.sphere(1)
body.set_data(object())
space = cstk.Space(cstk.Robot.load_urdf(FILE))
environment = cstk.Environment()
environment.add(body, data={1: 2})
cobject = cstk.CObject.predicate(space, lambda q: cstk.Class.OUTSIDE).with_data("x")
obstacles = cstk.CObject.induced(space, environment)
cobject = cobject | obstacles
query = cstk.Query()
query.classify(cobject, [0.0])
def work():
    own = cstk.Query()
    while True:
        own.distance(obstacles, [0.0])
threading.Thread(target=work, daemon=True).start()
threading.Event().wait(0.05)
# Collected after the modules are gone, as everything in a cycle is.
class Cycle:
    pass
cycle = Cycle()
cycle.all = [cycle, body, space, environment, cobject, query, obstacles]
del body, space, environment, cobject, query, cycle
"""
    urdf = '<robot name="a"><link name="b"/><link name="c"><collision><geometry><sphere radius="1"/></geometry></collision></link>'
    urdf += '<joint name="j" type="continuous"><parent link="b"/><child link="c"/></joint></robot>'
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "a.urdf")
        with open(file, "w", encoding="utf-8") as out:
            out.write(urdf)
        environment = {**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(cstk.__file__))}
        command = [sys.executable, "-X", "dev", "-c", f"FILE = {file!r}\n" + program]
        ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
    assert ended.returncode == 0 and not ended.stderr, ended.stderr


def test_bodies_go_to_another_process():
    body = cstk.Body.box([1, 2, 3])
    program = "import pickle, sys; print(pickle.load(sys.stdin.buffer).statistics().high.tolist())"
    environment = {**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(cstk.__file__))}
    command = [sys.executable, "-c", program]
    ended = subprocess.run(command, env=environment, input=pickle.dumps(body), capture_output=True, timeout=60, check=True)
    assert ended.stdout.decode().strip() == "[1.0, 2.0, 3.0]"
