"""Charts in axes of matplotlib: what is drawn is the data."""

import numpy as np
import pytest
from test_loading import example_body

import mceip

pyplot = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture
def axes():
    figure, axes = pyplot.subplots()
    yield axes
    pyplot.close(figure)


def words(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


def test_ranges_of_friction_are_drawn_with_the_critical_one(example, axes):
    analysis = example("point").analyze(samples=0)

    assert analysis.plot(axes) is axes

    assert words(axes)[:2] == ["absent, proved", "present, proved"]
    absent, present = axes.patches[:2]
    assert absent.get_x() == 0.0
    assert absent.get_width() == pytest.approx(4 / 3)
    assert present.get_x() == pytest.approx(4 / 3, rel=1e-4)
    asked, critical = (line.get_xdata()[0] for line in axes.lines)
    assert asked == 1.5 and critical == pytest.approx(4 / 3)


def test_a_path_is_drawn_step_by_step(axes):
    body, steps, friction = example_body()
    path = body.path(steps, friction)

    path.plot(axes)

    rows = path.resultants()
    assert rows.shape == (len(path.stretches) + 1, 3)
    assert rows[1] == pytest.approx([0.46625, -0.3, 4.23])
    assert rows[-1][0] == 2.0
    drawn = {line.get_label(): line.get_ydata() for line in axes.lines}
    assert np.array_equal(drawn["T, tangential"], rows[:, 1])
    assert np.array_equal(drawn["\u03bc N"], 0.8 * rows[:, 2])
    assert [text.get_text() for text in axes.texts] == ["press", "move"]


def test_growth_is_drawn_at_each_friction_examined(axes):
    body, steps, friction = example_body()
    own = body.path(steps, friction).own_critical("0.7", "1.5", parts=3)

    own.plot(axes)

    points = [line for line in axes.lines if line.get_marker() == "o"]
    assert [line.get_xdata()[0] for line in points] == [0.7, 1.0, 1.2, 1.5]
    assert [line.get_ydata()[0] for line in points] == [0.0] * 4
    assert words(axes) == ["absent"] and own.bounds is None


def test_a_mode_is_drawn_on_its_mesh(axes):
    points = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]
    displacement = np.array([[-1.0, 0.0], [-0.5, 0.0], [0.0, 0.1], [0.0, 0.0]])

    drawing = mceip.draw_mode(
        points, [[0, 1, 2, 3]], displacement, contacts=[0, 1], slipping=[1], title="a mode"
    )
    drawing.plot(axes)

    # A tenth of the longer side, 2.
    assert drawing.displaced[0] == pytest.approx([-0.2, 0.0])
    edges = [line for line in axes.lines if line.get_marker() == "None"]
    assert len(edges) == 2 * 4
    fills = [line.get_markerfacecolor() for line in axes.lines if line.get_marker() == "o"]
    assert fills == ["white", "black"]
    assert axes.get_title() == "a mode"


def test_new_axes_are_made_where_none_are_given(example):
    axes = example("point").analyze(samples=0).plot()
    assert axes.get_xlabel()
    pyplot.close(axes.figure)


def test_a_chart_without_matplotlib_says_what_is_missing(example, monkeypatch):
    analysis = example("point").analyze(samples=0)
    monkeypatch.setitem(__import__("sys").modules, "matplotlib.pyplot", None)
    with pytest.raises(mceip.MceipError, match="matplotlib"):
        analysis.plot()
