"""What ends a program passes through calls: Ctrl-C in every function of the caller's, and before its first line."""

import gc
import pathlib
import signal
import sys
import traceback

import numpy as np
import pytest

import cstk

package = pathlib.Path(cstk.__file__).parent


@pytest.fixture
def q(rng):
    return rng.uniform(-3, 3, (200_000, 2))


@pytest.fixture
def ask_until_interrupted(monkeypatch):
    """Asks once, and then until KeyboardInterrupt, raised after so many seconds as Ctrl-C does, wherever Python is then, has come
    through.

    Python drops what is raised while it collects garbage (the functions of weak references, generators that end), and says so:
    another interrupt follows then. One dropped without a word, or in a function of cstk, fails the test.
    """
    interrupted = False
    # The files of the functions that were left, of each.
    dropped = []

    def note(unraisable):
        frames = traceback.extract_tb(unraisable.exc_traceback)
        dropped.append((unraisable.exc_type, [frame.filename for frame in frames]))

    def interrupt(number, frame):
        nonlocal interrupted
        interrupted = True
        raise KeyboardInterrupt

    def ask_until(seconds, ask):
        nonlocal interrupted
        while True:
            ask()
            interrupted = False
            try:
                signal.setitimer(signal.ITIMER_REAL, seconds)
                while not interrupted:
                    ask()
                # What came while an object was released is raised by the next call.
                ask()
            except KeyboardInterrupt:
                return
            assert len(dropped) == 1, "a call returned as if there had been no interrupt"
            error, files = dropped.pop()
            assert error is KeyboardInterrupt
            assert not any(file.startswith(str(package)) for file in files)

    monkeypatch.setattr(sys, "unraisablehook", note)
    before = signal.signal(signal.SIGALRM, interrupt)
    yield ask_until
    signal.setitimer(signal.ITIMER_REAL, 0)
    signal.signal(signal.SIGALRM, before)
    assert not dropped


def raises(error):
    def function(*arguments):
        raise error

    return function


@pytest.mark.parametrize("error", [KeyboardInterrupt, SystemExit])
def test_what_ends_the_program_passes_through(arm, query, error):
    point = np.zeros(2)
    cobject = cstk.CObject.predicate(arm.space, raises(error))
    with pytest.raises(error):
        query.classify(cobject, point)
    with pytest.raises(error):
        cstk.Batch(threads=1).classify(cobject, [point])
    with pytest.raises(error):
        cstk.Batch(threads=1).classify(arm.cobject, [point], progress=raises(error))
    with pytest.raises(error):
        query.motion_function(arm.cobject, raises(error), point, point)
    with pytest.raises(error):
        cstk.BodyBuilder().add_support(raises(error))
    joint = cstk.CustomJoint(1, raises(error), raises(error))
    builder = cstk.RobotBuilder()
    with pytest.raises(error):
        builder.add_link(cstk.JointKind.CUSTOM, custom=joint)
        builder.build().link_pose([0.0], 0)
    # Nothing is left over for a later call.
    assert query.classify(arm.cobject, point) == cstk.Class.OUTSIDE
    with pytest.raises(cstk.NotFiniteError) as later:
        query.classify(arm.cobject, [np.nan, 0])
    assert later.value.__cause__ is None


def test_progress_ends_a_batch_whose_predicate_raised(arm, q):
    asked = []

    def classify(point):
        asked.append(point)
        raise KeyboardInterrupt

    cobject = cstk.CObject.predicate(arm.space, classify)
    with pytest.raises(KeyboardInterrupt):
        cstk.Batch(threads=1).classify(cobject, q, progress=lambda part: None)
    assert 0 < len(asked) < len(q) / 10


def test_interrupts_while_an_object_is_released_are_raised_by_the_next_call(arm, query):
    cobject = cstk.CObject.predicate(arm.space, lambda point: cstk.Class.OUTSIDE)

    def interrupt(frame, event, argument):
        if frame.f_code.co_name == "drop":
            raise KeyboardInterrupt

    gc.collect()
    sys.settrace(interrupt)
    cobject.release()
    gc.collect()
    sys.settrace(None)
    with pytest.raises(KeyboardInterrupt):
        query.classify(arm.cobject, [0, 0])
    assert query.classify(arm.cobject, [0, 0]) == cstk.Class.OUTSIDE


@pytest.mark.parametrize("delay", [0.02, 0.03, 0.04])
def test_signals_while_the_library_runs(arm, q, delay, ask_until_interrupted, capfd):
    """The signal is handled as the function begins, before its first line."""
    parts = []
    ask_until_interrupted(delay, lambda: cstk.Batch().classify(arm.cobject, q, progress=parts.append))
    assert parts and "ignored" not in capfd.readouterr().err


def test_signals_in_single_queries(arm, query, ask_until_interrupted, capfd):
    cobject = cstk.CObject.predicate(arm.space, lambda point: cstk.Class.OUTSIDE)
    for _ in range(20):
        ask_until_interrupted(0.01, lambda: query.classify(cobject, [0, 0]))
    assert "ignored" not in capfd.readouterr().err
