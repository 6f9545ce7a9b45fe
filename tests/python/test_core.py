"""Demonstrations, primitives and sequences: from numpy and back."""

import copy
import math
import pickle
import threading

import numpy as np
import pandas
import pytest

import seam
from conftest import movement, rise

T = np.linspace(0.0, 1.2, 301)
Y = np.column_stack([0.8 * rise(T / 1.2), np.sin(T)])


def demonstration():
    return seam.Demonstration(T, {"E1": Y[:, 0], "W1": Y[:, 1]})


def one(value=1.0):
    return seam.learn(movement({"E1": 0.0}, {"E1": value}))


class TestDemonstration:
    def test_is_the_same_from_a_dict_an_array_and_a_frame(self):
        by_name = demonstration()
        by_array = seam.Demonstration(T, Y, coordinates=["E1", "W1"])
        frame = pandas.DataFrame({"time": T, "E1": Y[:, 0], "W1": Y[:, 1]})
        for other in (by_array, seam.Demonstration(frame), seam.Demonstration(frame.set_index("time"))):
            assert other.coordinates == ("E1", "W1")
            for part in ("time", "position", "velocity", "acceleration"):
                np.testing.assert_array_equal(getattr(other, part), getattr(by_name, part))

    def test_takes_lists_integers_strides_and_columns_of_pandas(self):
        lists = seam.Demonstration(list(range(6)), [[0], [1], [4], [9], [16], [25]])
        assert lists.coordinates == ("y1",)
        np.testing.assert_allclose(lists.velocity[:, 0], 2.0 * np.arange(6), atol=1e-6)
        strided = seam.Demonstration(T[::2], Y[::2], coordinates=["a", "b"])
        np.testing.assert_array_equal(strided.position, Y[::2])
        seam.Demonstration(pandas.Series(T), {"a": pandas.Series(Y[:, 0])})

    def test_keeps_derivatives_that_are_given(self):
        velocity, acceleration = np.gradient(Y, T, axis=0), np.zeros_like(Y)
        demo = seam.Demonstration(T, Y, ["a", "b"], velocity=velocity, acceleration=acceleration)
        np.testing.assert_array_equal(demo.velocity, velocity)
        np.testing.assert_array_equal(demo.acceleration, acceleration)
        by_name = seam.Demonstration(T, {"a": Y[:, 0]}, velocity={"a": velocity[:, 0]})
        np.testing.assert_array_equal(by_name.velocity[:, 0], velocity[:, 0])

    def test_shows_its_memory_without_a_copy_for_as_long_as_a_view_lives(self):
        demo = demonstration()
        position, again = demo.position, demo.position
        assert position.__array_interface__["data"] == again.__array_interface__["data"]
        assert not position.flags.writeable and not position.flags.owndata
        del demo, again
        np.testing.assert_array_equal(position, Y)

    def test_reads_what_a_file_holds(self, tmp_path):
        path = tmp_path / "demo.csv"
        demonstration().to_pandas()[["E1", "W1"]].to_csv(path)
        read = seam.Demonstration.read(str(path))
        np.testing.assert_allclose(read.position, Y, rtol=0, atol=0)
        assert read.source == str(path)

    def test_is_pickled_whole(self):
        demo = demonstration()
        again = pickle.loads(pickle.dumps(demo))
        np.testing.assert_array_equal(again.acceleration, demo.acceleration)
        assert again.coordinates == demo.coordinates


    def test_a_frame_brings_its_derivatives(self):
        demo = demonstration()
        again = seam.Demonstration(demo.to_pandas())
        assert again.coordinates == demo.coordinates
        np.testing.assert_array_equal(again.velocity, demo.velocity)
        np.testing.assert_array_equal(again.acceleration, demo.acceleration)

    def test_takes_a_column_alone_and_no_mask(self):
        frame = demonstration().to_pandas()
        np.testing.assert_array_equal(seam.Demonstration(T, frame["E1"]).position[:, 0], Y[:, 0])
        with pytest.raises(seam.Error, match="masked"):
            seam.Demonstration(T, {"a": np.ma.masked_greater(T, 1.0)})


def test_enumerations_are_their_names():
    assert seam.Join.dmp3 == "dmp3" and seam.Join.dmp3 != "dmp2" and seam.Join.dmp3 != seam.Join.dmp2
    assert seam.Join("dmp2a") == seam.Join.dmp2a == seam.Join(1) and {"dmp3": 1}[seam.Join.dmp3] == 1
    assert pickle.loads(pickle.dumps(seam.Kind.rhythmic)) == seam.Kind.rhythmic
    assert seam.Join.dmp2 != seam.Kind.discrete and not seam.Join.dmp2 == 0
    for wrong in (17, "dmp9", None):
        with pytest.raises(seam.Error):
            seam.Join(wrong)


def test_numbers_of_numpy_are_numbers():
    for number in (np.float32(5), np.int64(5), np.array(5.0), 5, True + 4):
        assert seam.ControlSettings(Kp=number).Kp == 5.0


def test_paths_are_paths(tmp_path):
    one().write(tmp_path / "one.yaml")
    assert seam.Primitive.read(tmp_path / "one.yaml").coordinates == ("E1",)
    assert seam.Primitive.read(bytes(tmp_path / "one.yaml")).coordinates == ("E1",)


class TestPrimitive:
    def test_has_the_weights_of_least_squares(self):
        demo = demonstration()
        primitive = seam.learn(demo, kernels=12)
        gains, tau = primitive.gains, primitive.tau
        target = (tau**2 * demo.acceleration + tau * gains.D * demo.velocity
                  + gains.K * (demo.position - primitive.goal))
        x = np.exp(-primitive.alpha * T / tau)
        psi = np.exp(-((x[:, None] - primitive.kernels.centers) ** 2) / (2 * primitive.kernels.widths**2))
        A = x[:, None] * psi / psi.sum(axis=1, keepdims=True)
        weights = np.linalg.lstsq(A, target, rcond=None)[0]
        np.testing.assert_allclose(primitive.weights, weights, rtol=1e-7, atol=1e-7 * np.abs(weights).max())

    def test_takes_settings_as_an_object_or_one_by_one(self):
        by_object = seam.learn(demonstration(), seam.LearnSettings(kernels=9, gains=seam.Gains.critical(150)))
        by_name = seam.learn(demonstration(), kernels=9, gains=seam.Gains(150, 2 * math.sqrt(150), math.sqrt(150)))
        np.testing.assert_array_equal(by_object.weights, by_name.weights)
        rhythmic = seam.learn(seam.Demonstration(np.linspace(0, 6, 601), {"a": np.sin(np.linspace(0, 6, 601) * 4)}),
                              kind="rhythmic", period=math.pi / 2)
        assert rhythmic.kind == seam.Kind.rhythmic
        assert rhythmic.tau == pytest.approx(0.25)

    def test_arrays_are_set_whole_and_cannot_be_changed_within(self):
        primitive = one()
        with pytest.raises(ValueError, match="read-only"):
            primitive.weights[0] = 3.0
        kept = primitive.goal
        primitive.goal = [2.0]
        assert kept[0] == pytest.approx(1.0) and primitive.goal[0] == 2.0

    def test_is_copied_pickled_and_written_bit_for_bit(self, tmp_path):
        primitive = one()
        primitive.write(str(tmp_path / "one.yaml"))
        read = seam.Primitive.read(str(tmp_path / "one.yaml"))
        for other in (copy.deepcopy(primitive), pickle.loads(pickle.dumps(primitive)), read):
            np.testing.assert_array_equal(other.weights, primitive.weights)
            assert (other.tau, other.kind, other.coordinates) == (primitive.tau, primitive.kind, primitive.coordinates)

    def test_nested_settings_can_be_changed(self):
        settings = seam.ArmControllerSettings()
        settings.law.observer = 60
        settings.law.Kp = [1.0, 2.0]
        assert settings.law.observer == 60.0
        np.testing.assert_array_equal(settings.law.Kp, [1.0, 2.0])
        assert seam.ArmControllerSettings().law.Kp == 400.0


def rolled_out_by_runge_kutta(primitive, y, duration, steps):
    """Second order, Eqs. 1 to 4, by the classical method."""
    gains, kernels = primitive.gains, primitive.kernels

    def slope(state):
        y, v, x = state
        psi = np.exp(-((x - kernels.centers) ** 2) / (2 * kernels.widths**2))
        forcing = x * (psi @ primitive.weights[:, 0]) / psi.sum()
        return np.array([v, gains.K * (primitive.goal[0] - y) - gains.D * v + forcing, -primitive.alpha * x]) / primitive.tau

    state, h = np.array([y, 0.0, 1.0]), duration / steps
    for _ in range(steps):
        a = slope(state)
        b = slope(state + h / 2 * a)
        c = slope(state + h / 2 * b)
        state = state + h / 6 * (a + 2 * b + 2 * c + slope(state + h * c))
    return state[0]


class TestRollout:
    def test_solves_the_equations(self):
        primitive = one()
        path = seam.rollout(seam.Sequence().then(primitive), "dmp2", start=[0.0], dt=1e-3, duration=0.8)
        assert path.ticks == 801 and path.time[-1] == pytest.approx(0.8)
        assert path.ref["E1"][-1] == pytest.approx(rolled_out_by_runge_kutta(primitive, 0.0, 0.8, 4000), abs=1e-9)

    @pytest.mark.parametrize("join", ["dmp2", "dmp2a", "dmp3", "dmp2j"])
    def test_accelerations_step_with_dmp2_alone(self, join):
        task = seam.Sequence().then(one(), until=seam.before_end(0.4)).then(seam.learn(movement({"E1": 1.0}, {"E1": -0.5})))
        path = seam.rollout(task, join)
        change = seam.jump(path.time, path.ref_acc, path.joins[1].time)
        peak = np.abs(path.ref_acc).max()
        assert (abs(change[0]) > 0.1 * peak) == (join == "dmp2")
        assert (path.joins[1].acceleration_jump > 1e-9 * peak) == (join == "dmp2")

    def test_of_a_tool_is_in_task_space(self):
        t = np.linspace(0, 1, 101)
        tool = seam.learn(seam.Demonstration(t, {"x": 0.1 * rise(t), "y": 0 * t, "z": 0.2 * rise(t)}))
        path = seam.rollout(seam.Sequence().then(tool), "dmp3")
        assert path.in_task_space and path.joints == ()
        assert path.tool_ref["z"][-1] == pytest.approx(0.2, abs=5e-3)

    def test_of_a_sequencer_goes_on_from_where_it_is(self):
        task = seam.Sequence().then(one(), until=seam.before_end(0.4)).then(one(0.5))
        whole = seam.rollout(task, "dmp3", dt=1e-3, duration=1.5)
        sequencer = seam.Sequencer(task, "dmp3")
        for _ in range(500):
            sequencer.step(1e-3)
        rest = seam.rollout(sequencer, dt=1e-3, duration=1.0)
        np.testing.assert_array_equal(rest.ref[:, 0], whole.ref[500:, 0])
        assert [join.primitive for join in rest.joins] == [1]


class TestSequencer:
    def play(self, change, join="dmp2a"):
        sequencer = seam.Sequencer(seam.Sequence().then(one(), until=seam.on_call()), join, start=[0.0])
        for k in range(3000):
            if k == 400:
                assert change(sequencer)
            sequencer.step(1e-3)
        return sequencer

    def test_changes_goal_tau_and_rate_on_the_way(self):
        assert self.play(lambda s: s.set_goal([0.3])).sample.position[0] == pytest.approx(0.3, abs=1e-3)
        assert self.play(lambda s: s.set_tau(0.5)).sample.position[0] == pytest.approx(1.0, abs=1e-3)
        paused = self.play(lambda s: s.set_rate(0.0, 0.2))
        assert paused.rate == 0.0 and paused.sample.velocity[0] == 0.0

    def test_hands_over_appends_and_replaces(self):
        sequencer = seam.Sequencer(seam.Sequence().then(one(), until=seam.on_call()), "dmp3")
        assert not sequencer.finished
        sequencer.append(seam.Sequence().then(one(2.0), until=seam.on_call()))
        sequencer.replace(seam.Sequence().then(one(3.0)))
        sequencer.step(0.1)
        assert sequencer.hand_over()
        assert sequencer.running == 1 and sequencer.goal[0] == pytest.approx(3.0)
        np.testing.assert_allclose(sequencer.join(1).acceleration_after, sequencer.join(1).acceleration_before, atol=1e-9)

    def test_amplitude_is_for_rhythmic_primitives(self):
        t = np.linspace(0, 4, 801)
        wipe = seam.learn(seam.Demonstration(t, {"E1": np.sin(2 * np.pi * t)}), kind="rhythmic", period=1.0)
        rhythm = seam.Sequencer(seam.Sequence().then(wipe, until=seam.after_cycles(9)), "dmp2j")
        assert rhythm.set_amplitude(0.5)
        assert not seam.Sequencer(seam.Sequence().then(one()), "dmp2j").set_amplitude(0.5)

    def test_settings_of_the_join_count(self):
        task = seam.Sequence().then(one(), until=seam.before_end(0.4)).then(one(0.2))
        ends = [seam.rollout(task, join).ref[900, 0] for join in
                (seam.Join.dmp2a, seam.JoinSettings("dmp2a", "strongest"), "dmp2a")]
        assert ends[0] == ends[2] != ends[1]


def test_sequences_chain_and_are_pickled():
    task = seam.Sequence().start_after(0.1).then(one()).until(seam.before_end(0.2)).then(one(), until=seam.near_goal(0.01))
    again = pickle.loads(pickle.dumps(task))
    assert len(again) == 2 and again.start_delay == 0.1
    assert again.steps[0].until.value == 0.2
    assert again.steps[1].until.when == seam.Switch.When.near_goal


def test_a_sequence_file_comes_back(tmp_path):
    task = seam.Sequence().then(one(), until=seam.before_end(0.3)).then(one(0.5))
    seam.write_sequence(str(tmp_path / "task.yaml"), seam.SequenceFile(task, ["there", "on"]))
    file = seam.read_sequence(str(tmp_path / "task.yaml"))
    assert file.primitives == ("there", "on")
    assert seam.rollout(file.sequence, "dmp3").ref[-1, 0] == seam.rollout(task, "dmp3").ref[-1, 0]


def test_orientations_go_through_the_rotation_vector():
    q0 = np.array([0.0, 0.0, 0.0, 1.0])
    half = np.array([0.0, 0.0, np.sin(0.4), np.cos(0.4)])
    np.testing.assert_allclose(seam.rotation_vector(half, q0), [0, 0, 0.8], atol=1e-15)
    np.testing.assert_allclose(seam.orientation([0, 0, 0.8], q0), half, atol=1e-15)
    within, state = seam.to_orientation(seam.RotationState([0, 0, 0.8], [0, 0, 1.5]), q0)
    assert within
    np.testing.assert_allclose(state.velocity, [0, 0, 1.5], atol=1e-14)


def test_a_sequence_may_grow_while_another_thread_plays_it():
    task = seam.Sequence().then(one())
    paths = []
    thread = threading.Thread(target=lambda: paths.extend(seam.rollout(task, "dmp3", dt=1e-4, duration=1.5) for _ in range(20)))
    thread.start()
    more = one()
    while thread.is_alive():
        if len(task) < 300:
            task.then(more)
    thread.join()
    assert all(np.isfinite(path.ref).all() for path in paths) and len(task) > 1


def test_learning_lets_other_threads_go_on():
    t = np.linspace(0, 10, 20001)
    demo = seam.Demonstration(t, np.sin(np.outer(t, np.arange(1, 8))))
    turns, over = 0, threading.Event()

    def learn():
        seam.learn(demo, kernels=100)
        over.set()

    thread = threading.Thread(target=learn)
    thread.start()
    while not over.wait(0.0005):
        turns += 1
    thread.join()
    assert turns > 5
