"""Plots show what is in a recording."""

import numpy as np
import pytest

import seam

matplotlib = pytest.importorskip("matplotlib")
pyplot = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture(scope="module")
def run():
    return seam.play("line", method="dmp2", dt=2e-3)


@pytest.fixture(autouse=True)
def close():
    yield
    pyplot.close("all")


def lines(axis):
    return [line for line in axis.get_lines() if len(line.get_xdata()) > 2]


def test_shows_position_velocity_acceleration_and_torque(run, tmp_path):
    figure = seam.plot(run)
    assert [axis.get_ylabel().split()[0] for axis in figure.axes] == ["position", "velocity", "acceleration", "torque"]
    name = figure.axes[0].get_title()
    for axis, part in zip(figure.axes, (run.ref, run.ref_vel, run.ref_acc, run.torque)):
        [line] = lines(axis)
        np.testing.assert_array_equal(line.get_ydata(), part[name])
    assert len(figure.axes[0].get_lines()) == 1 + len(run.joins)
    figure.savefig(tmp_path / "run.png")
    assert (tmp_path / "run.png").stat().st_size > 10_000


def test_compares_runs_around_a_join(run):
    other = seam.play("line", method="dmp3", dt=2e-3)
    figure = seam.plot({"dmp2": run, "dmp3": other}, join=1, within=0.1)
    assert [len(lines(axis)) for axis in figure.axes] == [2, 2, 2, 2]
    assert figure.axes[3].get_xlim() == pytest.approx((run.joins[1].time - 0.1, run.joins[1].time + 0.1))
    assert [text.get_text() for text in figure.axes[0].get_legend().get_texts()] == ["dmp2", "dmp3"]


def test_a_rollout_has_no_torque():
    t = np.linspace(0, 1, 101)
    path = seam.rollout(seam.Sequence().then(seam.learn(seam.Demonstration(t, {"E1": t**2}))), "dmp3")
    assert len(seam.plot(path).axes) == 3


def test_refuses_what_is_not_there(run):
    with pytest.raises(KeyError, match='no joint or coordinate "Q9"'):
        seam.plot(run, of="Q9")
    with pytest.raises(TypeError, match="no recording"):
        seam.plot()
    with pytest.raises(ValueError, match="2 labels, must be 1"):
        seam.plot(run, labels=["a", "b"])
    with pytest.raises(ValueError, match="nothing to plot"):
        seam.plot(seam.Recording(joints=["a"], time=[0.0, 1.0]))
