"""A search in parts, by executors of `concurrent.futures`."""

from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor

import pytest

import mceip


class Enough(Exception):
    """What a listener raises in these tests."""


class AtOnce(Executor):
    """Does each task when it is submitted; the last one first in `as_completed`'s eyes."""

    def __init__(self):
        self.tasks = []

    def submit(self, task, /, *arguments, **named):
        future = Future()
        self.tasks.append(arguments[1])
        future.set_result(task(*arguments, **named))
        return future


@pytest.mark.parametrize("workers", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_parts_are_searched_by_an_executor_and_joined(example, workers):
    problem = example("fold")
    heard = []

    with workers(2) as executor:
        joined = problem.complete(
            executor=executor, parts=5, progress=lambda *what: heard.append(what)
        )

    assert joined.is_complete
    assert [solution.value for solution in joined.solutions] == [2.0, 3.0]
    assert mceip.check(problem, joined.certificate).is_complete
    assert joined.certificate == problem.complete().certificate
    assert heard == [(f"{done} of 5 parts searched", done, 5) for done in range(1, 6)]


def test_more_parts_than_pieces_cut_the_window_further(example):
    problem = example("fold")
    executor = AtOnce()

    joined = problem.complete(executor=executor, parts=40)

    assert executor.tasks == list(range(40))
    assert joined.is_complete and len(joined.solutions) == 2


def test_parts_are_merged_and_a_missing_one_is_refused(example):
    problem = example("fold")
    executor = AtOnce()
    certificates = []
    submit = executor.submit

    def kept(*arguments):
        future = submit(*arguments)
        certificates.append(future.result())
        return future

    executor.submit = kept
    problem.complete(executor=executor, parts=3)

    assert problem.merge(certificates).is_complete
    with pytest.raises(mceip.MceipError):
        problem.merge(certificates[:2])
    with pytest.raises(mceip.MceipError):
        example("point").merge(certificates)
    with pytest.raises(mceip.MceipError):
        problem.merge([])


def test_an_exception_of_the_listener_cancels_the_parts(example):
    def stop(text, done, total):
        raise Enough

    with ThreadPoolExecutor(1) as executor, pytest.raises(Enough):
        example("fold").complete(executor=executor, parts=4, progress=stop)


def test_what_makes_no_parts_is_refused(example):
    problem = example("fold")
    certificate = problem.complete().certificate
    with ThreadPoolExecutor(1) as executor:
        for options in ({"parts": 0}, {"parts": 10**6}, {"resume": certificate}):
            with pytest.raises(mceip.MceipError):
                problem.complete(executor=executor, **options)
