"""Progress, exceptions of the listener, Ctrl-C, and other threads beside long work."""

import os
import signal
import sys
import threading
import time

import pytest


class Enough(Exception):
    """What a listener raises in these tests."""


def stop(text, done, total):
    raise Enough


def test_progress_is_heard(slow):
    heard = []

    slow.solve(starts=8, all=True, progress=lambda *what: heard.append(what))

    assert heard
    for text, done, total in heard:
        assert isinstance(text, str) and text
        assert isinstance(done, int)
        assert total is None or isinstance(total, int)


def test_an_exception_of_the_listener_ends_the_work(slow, example):
    with pytest.raises(Enough):
        slow.solve(starts=5_000, all=True, progress=stop)
    with pytest.raises(Enough):
        slow.complete(progress=stop)
    with pytest.raises(Enough):
        example("two-particles").analyze(progress=stop)


@pytest.fixture
def interruptible():
    """Python's own handler of Ctrl-C, which it does not set when started in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_an_interrupt_ends_the_work(slow, interruptible):
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        slow.solve(starts=5_000, all=True)


def test_other_threads_go_on_beside_long_work(slow):
    steps = []
    is_over = threading.Event()

    def count():
        while not is_over.wait(0.01):
            steps.append(time.monotonic())

    counting = threading.Thread(target=count)
    counting.start()
    begin = time.monotonic()
    slow.solve(starts=30, all=True)
    duration = time.monotonic() - begin
    is_over.set()
    counting.join()

    assert duration > 0.1
    assert len(steps) > duration / 0.2


def test_a_short_question_is_answered_at_once(example):
    problem = example("fold")
    durations = []
    for _ in range(20):
        begin = time.monotonic()
        problem.solve()
        durations.append(time.monotonic() - begin)

    # Signals are looked at every 0.05 s; the answer does not wait for it.
    assert min(durations) < 0.04


def test_progress_is_a_bar_of_tqdm_or_lines(slow, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    slow.solve(starts=8, all=True, progress=True)
    assert capsys.readouterr().err

    monkeypatch.undo()
    pytest.importorskip("tqdm")
    slow.solve(starts=8, all=True, progress=True)
    assert slow.solve(progress=False).runs == slow.solve().runs


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_process_that_is_forked_after_a_search_can_search(example):
    problem = example("two-particles")
    problem.complete()

    child = os.fork()
    if child == 0:
        os._exit(0 if problem.complete().is_complete else 1)

    deadline = time.monotonic() + 60
    ended = (0, 0)
    while ended[0] == 0 and time.monotonic() < deadline:
        ended = os.waitpid(child, os.WNOHANG)
        time.sleep(0.01)
    if ended[0] == 0:
        os.kill(child, signal.SIGKILL)
    assert ended == (child, 0)
