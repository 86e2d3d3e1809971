"""Charts of answers in axes of matplotlib, which is needed for these functions alone."""

from __future__ import annotations

import importlib
from itertools import groupby
from typing import TYPE_CHECKING, Any

from ._native import MceipError
from .exact import fraction_of, fraction_or_none

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .answers import Analysis
    from .drawing import Drawing
    from .loading import LoadPath, OwnCritical

#: Colours of the answers: vermilion, blue and grey, told apart by colour-blind readers.
COLOURS = {"present": "#d55e00", "absent": "#0072b2", "undecided": "#999999", "no path": "#000000"}


def axes_or_new(ax: Axes | None) -> Axes:
    """The axes that are given, or those of a new figure."""
    if ax is not None:
        return ax
    try:
        pyplot: Any = importlib.import_module("matplotlib.pyplot")
    except ImportError:
        raise MceipError("plot: expected matplotlib, which is not installed") from None
    new: Axes = pyplot.subplots()[1]
    return new


def plot_ranges(analysis: Analysis, ax: Axes | None) -> Axes:
    """Where along mu divergence is present and absent, and the critical friction."""
    ax = axes_or_new(ax)
    answer = analysis.answer
    friction = float(fraction_of(answer["friction"]))
    ranges = []
    for found in answer["ranges"]:
        end = fraction_or_none(found["to"])
        ranges.append((found, float(fraction_of(found["from"])), end))
    ends = [friction, *(start for _, start, _ in ranges)]
    ends += [float(end) for _, _, end in ranges if end is not None]
    last = 1.1 * max(ends)

    for found, start, end in ranges:
        stop = last if end is None else float(end)
        strip(ax, found["verdict"], start, stop, is_proved=found["proved"])
    ax.axvline(friction, color="black", linestyle=":", label=f"\u03bc = {friction:g}, asked for")
    bounds = analysis.critical_friction
    if bounds is not None:
        ax.axvline(float(bounds.upper), color="black", label=f"critical: {bounds}")
    ax.set(
        xlim=(0, last),
        ylim=(0, 1),
        yticks=[],  # up and down mean nothing
        xlabel="friction coefficient \u03bc",
        title="divergence of the form (8), contact states held",
    )
    return with_legend(ax)


def plot_own_critical(own: OwnCritical, ax: Axes | None) -> Axes:
    """The largest growth rate proved at each mu that was examined, 0 where divergence is absent,
    and the ends of the bracket."""
    ax = axes_or_new(ax)
    for point in own.points:
        verdict = point.get("divergence", "no path")
        mu = float(fraction_of(point["mu"]))
        squares = [float(fraction_of(upper)) for _, upper in point.get("lambda2", [])]
        rate = max(squares, default=0.0) ** 0.5
        marker = "x" if verdict == "no path" else "o"
        ax.plot(mu, rate, marker, color=COLOURS[verdict], label=verdict)
    for end in (own.absent, own.critical):
        if end is not None:
            ax.axvline(float(end), color="black", linestyle=":")
    ax.set(
        xlabel="friction coefficient \u03bc",
        ylabel="largest growth rate proved, 1/s",
        title="divergence in the equilibrium that the loads lead to",
    )
    return with_legend(ax)


def strip(ax: Axes, verdict: str, start: float, stop: float, *, is_proved: bool) -> None:
    """A range of mu; hatched where its answer is not proved."""
    label = f"{verdict}, {'proved' if is_proved else 'not proved'}"
    hatch = None if is_proved else "//"
    colour = COLOURS[verdict]
    ax.axvspan(start, stop, facecolor=colour, alpha=0.5, hatch=hatch, label=label)


def with_legend(ax: Axes) -> Axes:
    """A legend with each label once."""
    handles, labels = ax.get_legend_handles_labels()
    once = dict(zip(labels, handles))
    ax.legend(once.values(), once.keys(), fontsize="small")
    return ax


def plot_path(path: LoadPath, ax: Axes | None) -> Axes:
    """Resultants against the load: T, N and mu N, with a dot where a stretch begins."""
    ax = axes_or_new(ax)
    load, tangential, normal = path.resultants().T
    ax.plot(load, tangential, "-o", markersize=4, label="T, tangential")
    ax.plot(load, normal, "--", label="N, normal")
    ax.plot(load, float(path.friction) * normal, ":", label="\u03bc N")
    begins = zip(path.stretches, load)
    for step, stretches in groupby(begins, key=lambda begin: begin[0].step):
        start = next(stretches)[1]
        ax.axvline(start, color="#999999", linewidth=0.8)
        ax.annotate(step, (start, 1.0), xycoords=("data", "axes fraction"), va="bottom")
    ax.set(xlabel="load: the amounts of the steps, one after the other", ylabel="resultants")
    ax.legend(fontsize="small")
    return ax


def plot_drawing(drawing: Drawing, ax: Axes | None) -> Axes:
    """The mesh at rest, dashed, and displaced, with a circle on each contact, filled if it slips."""
    ax = axes_or_new(ax)
    rest, displaced = drawing.rest, drawing.displaced
    for points, colour, style in ((rest, "#999999", "--"), (displaced, "#222222", "-")):
        for edge in drawing.edges:
            x, y = points[list(edge)].T
            ax.plot(x, y, style, color=colour, linewidth=0.9)
    for place, point in enumerate(drawing.contacts):
        filled = "black" if place in drawing.slipping else "white"
        x, y = displaced[point]
        ax.plot(x, y, "o", markerfacecolor=filled, markeredgecolor="black")
    ax.set_aspect("equal")
    ax.set_axis_off()
    if drawing.title:
        ax.set_title(drawing.title)
    return ax
