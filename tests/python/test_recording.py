"""Recordings: columns by name, pandas, measuring, matchers."""

import math
import pickle

import numpy as np
import pytest

import seam

T = 1e-3 * np.arange(1001)
STEP = np.where(T >= 0.5, 1.5, 0.0)


def recording():
    """A torque that steps by 1.5 N m at 0.5 s."""
    return seam.Recording(joints=["a", "b"], effort=[10.0, 20.0], time=T, running=(T >= 0.5).astype(int),
                          torque=np.column_stack([np.sin(T), np.cos(T) + STEP]), joins=[seam.RecordedJoin(0.5, 1)],
                          signals={"level_m": T}, outcomes={"poured_share": 0.7}, source="here")


def test_columns_are_found_by_name_and_by_number():
    run = recording()
    assert run.torque.shape == (1001, 2)
    np.testing.assert_array_equal(run.torque["b"], run.torque[:, 1])
    np.testing.assert_array_equal((2 * run.torque)[:, 0], 2 * np.sin(T))
    assert type(2 * run.torque) is np.ndarray and type(run.torque.max()) is np.float64
    assert run.torque.copy()["b"][0] == run.torque["b"][0]
    assert run.torque[["b", "a"]]["a"][5] == run.torque["a"][5]
    with pytest.raises(KeyError, match='no column "c", there are a, b'):
        run.torque["c"]
    with pytest.raises(ValueError, match="read-only"):
        run.torque[0, 0] = 1.0


def test_views_keep_the_recording():
    torque = recording().torque
    np.testing.assert_array_equal(torque[:, 0], np.sin(T))


def test_measures_a_step():
    metrics = seam.measure(recording())
    assert metrics.torque_jump_nm == pytest.approx(1.5, abs=1e-5)
    assert metrics.torque_jump_percent == pytest.approx(7.5, abs=1e-4)
    assert [join.joint for join in metrics.joins] == [1]
    assert math.isnan(metrics.tracking_max_rad)
    half = seam.Recording(joints=["a", "b"], time=T / 2, torque=np.column_stack([np.sin(T / 2), np.cos(T / 2) + STEP]),
                          joins=[seam.RecordedJoin(0.25, 1)])
    with pytest.raises(seam.Error, match="other joins"):
        seam.measure(recording(), half=half)


def test_measures_at_times_that_are_told():
    run = seam.Recording(joints=["a", "b"], time=T, torque=recording().torque)
    assert math.isnan(seam.measure(run).torque_jump_nm)
    assert seam.measure(run, joins=[0.5]).torque_jump_nm == pytest.approx(1.5, abs=1e-5)
    with pytest.raises(seam.Error, match="finite"):
        seam.measure(run, joins=[math.nan])


def test_is_what_it_was_made():
    for name in ("time", "torque", "joins", "source", "outcomes"):
        with pytest.raises(AttributeError):
            setattr(recording(), name, None)


def test_matchers_say_why_not():
    assert seam.TorqueIsContinuousAt(0.5).within(2.0).why_not(recording()) == ""
    assert "joint b steps by 1.5 N·m at 0.5 s" in seam.TorqueIsContinuousAtAllJoins().within(0.5).why_not(recording())
    assert "ref and q" in seam.TracksWithin(1e-3).why_not(recording())


def test_comes_back_from_its_file_and_from_pickle(tmp_path):
    run = recording()
    run.write(str(tmp_path / "run.csv"))
    for again in (seam.Recording.read(str(tmp_path / "run.csv")), pickle.loads(pickle.dumps(run))):
        np.testing.assert_array_equal(again.torque, run.torque)
        np.testing.assert_array_equal(again.signals["level_m"], T)
        assert again.joins[0].time == 0.5
    assert pickle.loads(pickle.dumps(run)).outcomes == {"poured_share": 0.7}


def test_goes_to_pandas():
    pandas = pytest.importorskip("pandas")
    frame = recording().to_pandas()
    assert list(frame.columns) == ["switch", "torque.a", "torque.b", "level_m"]
    assert frame.index.name == "time"
    pandas.testing.assert_series_equal(frame["torque.a"], pandas.Series(np.sin(T), index=frame.index), check_names=False)
