"""What notebooks show: tables and drawings."""

from xml.etree import ElementTree

import numpy as np
import pytest

import mceip

POINTS = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]


def test_answers_are_tables(example):
    everything = example("fold").complete()
    assert "complete" in everything._repr_html_()
    assert "<td>2</td>" in everything._repr_html_()
    heading = "<th>lambda2</th><th>enclosure</th><th>support</th>"
    assert heading in everything._repr_html_()
    assert "2 found" in example("fold").solve()._repr_html_()

    html = example("point").analyze(samples=0)._repr_html_()
    assert "PRESENT" in html and "certificate: lambda2" in html
    ElementTree.fromstring(f"<div>{html}</div>")


def test_a_mode_is_drawn(tmp_path):
    displacement = np.array([[-1.0, 0.0], [-0.5, 0.0], [0.0, 0.1], [0.0, 0.0]])

    drawing = mceip.draw_mode(
        POINTS, [[0, 1, 2, 3]], displacement, contacts=[0, 1], slipping=[1], title="a < b"
    )

    drawing.save(tmp_path / "mode.svg")
    with pytest.raises(mceip.MceipError, match="ends in .svg, got .*mode.png"):
        drawing.save(tmp_path / "mode.png")
    root = ElementTree.parse(tmp_path / "mode.svg").getroot()
    name = "{http://www.w3.org/2000/svg}"
    assert root.findtext(name + "title") == "a < b"
    circles = root.findall(name + "circle")
    assert [circle.get("fill") for circle in circles] == ["#fff", "#000"]
    # The first contact moves to the left by a tenth of the longer side: 64 of 640 px.
    assert [float(circle.get("cx")) for circle in circles] == [110.0 - 64.0, 750.0 - 32.0]
    edges = root.findall(name + "path")[1].get("d")
    assert edges.count("M") == 4
    assert drawing._repr_svg_() == drawing.svg


def test_a_mode_without_displacement_is_drawn_at_rest():
    drawing = mceip.draw_mode(POINTS, [[0, 1, 2]], np.zeros((4, 2)))
    assert "nan" not in drawing.svg


@pytest.mark.parametrize(
    "points, cells, displacement, message",
    [
        (POINTS, [[0, 1, 2]], np.zeros((3, 2)), "displacement"),
        (np.zeros((2, 4)), [[0, 1, 2]], np.zeros((2, 4)), "points"),
        (POINTS, [0, 1, 2], np.zeros((4, 2)), "cells"),
        (POINTS, [[0, 1, 4]], np.zeros((4, 2)), "cells"),
        (POINTS, [[0.0, 1.0, 2.0]], np.zeros((4, 2)), "cells"),
        (POINTS, [[0, 1, 2]], np.full((4, 2), np.nan), "finite"),
    ],
)
def test_what_is_no_mesh_is_refused(points, cells, displacement, message):
    with pytest.raises(mceip.MceipError, match=message):
        mceip.draw_mode(points, cells, displacement)
