"""Recordings as frames of pandas, and as pictures."""

from typing import Any, Iterator, List, Optional, Tuple

import numpy

KINDS = ("ref", "ref_vel", "ref_acc", "q", "qd", "torque")


def _demonstration_columns(demo: Any) -> Iterator[Tuple[str, Any]]:
    for prefix, values in (("", demo.position), ("vel.", demo.velocity), ("acc.", demo.acceleration)):
        for i, name in enumerate(demo.coordinates):
            yield prefix + name, values[:, i]


def _recording_columns(run: Any) -> Iterator[Tuple[str, Any]]:
    if run.running.size:
        yield "switch", run.running
    for kind in KINDS:
        for i, name in enumerate(run.joints if getattr(run, kind).size else ()):
            yield f"{kind}.{name}", getattr(run, kind)[:, i]
    for kind, values in (("ref", run.tool_ref), ("ref_vel", run.tool_vel), ("ref_acc", run.tool_acc)):
        for i, name in enumerate(run.coordinates if values.size else ()):
            yield f"{kind}.{name}", values[:, i]
    for name in ("tool_error_m", "tool_error_rad"):
        if getattr(run, name).size:
            yield name, getattr(run, name)
    yield from run.signals.items()


def to_pandas(self: Any) -> Any:
    """The same as a frame of pandas, a column for each column of its CSV file, with time [s] as the index.

    Raises:
        ImportError: pandas is not installed
    """
    import pandas  # type: ignore

    columns = _recording_columns(self) if hasattr(self, "running") else _demonstration_columns(self)
    return pandas.DataFrame(dict(columns), index=pandas.Index(self.time, name="time"))


# Of all that has a position in a recording: where it is, its derivatives, its torque.
def _signals(run: Any, name: str) -> List[Tuple[str, Any]]:
    if name in run.joints:
        parts = [run.ref, run.ref_vel, run.ref_acc, run.torque]
        angle = not run.slides_at(list(run.joints).index(name))
        unit, effort = ("rad", "N·m") if angle else ("m", "N")
    elif name in run.coordinates:
        parts = [run.tool_ref, run.tool_vel, run.tool_acc]
        unit, effort = ("rad" if name.startswith("r") else "m"), ""
    else:
        raise KeyError(f'no joint or coordinate "{name}", there are {", ".join([*run.joints, *run.coordinates])}')
    titles = [f"position [{unit}]", f"velocity [{unit}/s]", f"acceleration [{unit}/s²]", f"torque [{effort}]"]
    return [(title, part[name]) for title, part in zip(titles, parts) if part.size]


def _most_disturbed(run: Any) -> str:
    """The joint (else coordinate) whose acceleration steps most at the joins, or that moves most where none does."""
    from . import jump

    found = [values for values in (run.ref_acc, run.tool_acc, run.torque) if values.size]
    if not found:
        raise ValueError(f"{run.source}: nothing to plot, it has neither references nor torques")
    values = found[0]
    steps = [numpy.abs(jump(run.time, values, join.time)) for join in run.joins]
    steps = [step for step in steps if numpy.isfinite(step).all()]
    of_all = numpy.max(steps, axis=0) if steps else numpy.zeros(values.shape[1])
    spread = numpy.ptp(values, axis=0)
    return str(values.names[int(numpy.argmax(of_all if of_all.max() > 0.01 * spread.max() else spread))])


def plot(
    *runs: Any,
    of: Optional[str] = None,
    labels: Optional[List[str]] = None,
    around: Optional[float] = None,
    join: Optional[int] = None,
    within: float = 0.3,
) -> Any:
    """Position, velocity, acceleration and torque over time, in four stacked plots, the joins marked.

    Args:
        runs: Recordings, to be compared; or one dict of labels and Recordings
        of: joint or coordinate; None: the joint whose acceleration steps most at a join
        labels: a name for each run, for the legend
        around: time [s] to look at closely; None: all of it
        join: the same for a join, by its index in the first recording's `joins`; 0 is the start
        within: [s] to either side of it

    Returns:
        a matplotlib Figure; show it with matplotlib.pyplot.show() or save it by its savefig("run.png")

    Raises:
        ImportError: matplotlib is not installed
        KeyError: there is no such joint or coordinate
    """
    from matplotlib import pyplot  # type: ignore

    if len(runs) == 1 and isinstance(runs[0], dict):
        labels, runs = list(runs[0]), tuple(runs[0].values())
    if not runs:
        raise TypeError("plot: no recording is given")
    if labels is not None and len(labels) != len(runs):
        raise ValueError(f"plot: {len(labels)} labels, must be {len(runs)}, one for each recording")
    of = _most_disturbed(runs[0]) if of is None else of
    signals = [_signals(run, of) for run in runs]
    titles = [title for title, _ in signals[0]]
    figure, axes = pyplot.subplots(len(titles), 1, sharex=True, figsize=(8, 2 * len(titles)), squeeze=False)
    for index, (run, parts) in enumerate(zip(runs, signals)):
        for axis, (_, values) in zip(axes[:, 0], parts):
            axis.plot(run.time, values, linewidth=1.2, label=labels[index] if labels else None)
    if join is not None:
        if not -len(runs[0].joins) <= join < len(runs[0].joins):
            raise IndexError(f"plot: join {join}, the recording has {len(runs[0].joins)}")
        around = runs[0].joins[join].time
    for axis, title in zip(axes[:, 0], titles):
        axis.set_ylabel(title)
        axis.grid(alpha=0.3)
        for change in runs[0].joins:
            axis.axvline(change.time, color="0.5", linewidth=0.8, linestyle="--")
        if around is not None:
            _look_closely(axis, around - within, around + within)
    axes[-1, 0].set_xlabel("time [s]")
    axes[0, 0].set_title(of)
    if labels:
        axes[0, 0].legend(loc="upper right")
    figure.align_ylabels()
    figure.tight_layout()
    return figure


def _look_closely(axis: Any, begin: float, end: float) -> None:
    """Shows a stretch of time, as high as what is there."""
    parts = [line.get_ydata()[(line.get_xdata() >= begin) & (line.get_xdata() <= end)]
            for line in axis.get_lines() if len(line.get_xdata()) > 2]
    seen = numpy.concatenate(parts) if parts else numpy.array([])
    axis.set_xlim(begin, end)
    if seen.size:
        margin = 0.05 * (numpy.ptp(seen) or 1.0)
        axis.set_ylim(seen.min() - margin, seen.max() + margin)
