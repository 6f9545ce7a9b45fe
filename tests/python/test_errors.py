"""What is refused: one clear line, and never a crash."""

import subprocess
import sys

import numpy as np
import pytest

import seam
from conftest import PA10, movement

T = np.linspace(0.0, 1.0, 101)


def refused(call, *parts, error=seam.Error):
    with pytest.raises(error) as caught:
        call()
    text = str(caught.value)
    assert "\n" not in text
    for part in parts:
        assert part in text, text


def test_an_error_is_a_value_error():
    assert issubclass(seam.Error, ValueError)
    refused(lambda: seam.RobotModel.read("nowhere.urdf"), "nowhere.urdf")


def test_demonstrations():
    refused(lambda: seam.Demonstration(T, {"a": T[:-1]}), "position a", "(100,)", "(101,)")
    refused(lambda: seam.Demonstration(T, {"a": ["x"] * 101}), "position a", "numbers")
    refused(lambda: seam.Demonstration(T, {"a": T * 1j}), "position a", "complex128")
    refused(lambda: seam.Demonstration(T, {"a": np.where(T > 0.5, np.nan, T)}), "finite")
    refused(lambda: seam.Demonstration(T[::-1], {"a": T}), "demonstration")
    refused(lambda: seam.Demonstration([], {}), "demonstration")
    refused(lambda: seam.Demonstration(T), "needs time and position")
    refused(lambda: seam.Demonstration(T, np.zeros((101, 2)), ["a"]), "demonstration")
    refused(lambda: seam.Demonstration(T, np.zeros((101, 2, 2))), "position", "(101, 2, 2)")
    refused(lambda: seam.Demonstration(T, {"a": T}, velocity={"b": T}), "velocity", '"a"')
    refused(lambda: seam.Demonstration(T, {"a": T}, velocity=np.zeros((3, 1))), "velocity")


def test_settings():
    refused(lambda: seam.Gains(kp=3), "Gains has no kp, but K, D, H", error=TypeError)
    refused(lambda: seam.Gains(1, 2, 3, 4), "3 attributes", error=TypeError)
    refused(lambda: seam.Gains(1, K=2), "K given twice", error=TypeError)
    refused(lambda: seam.Gains(K="stiff"), "Gains.K", "stiff", error=TypeError)
    refused(lambda: seam.LearnSettings(kind="cyclic"), "Kind", '"cyclic"', "discrete, rhythmic")
    refused(lambda: seam.learn(movement({"a": 0}, {"a": 1}), kernel=3), "has no kernel", error=TypeError)
    refused(lambda: seam.ToolSettings(X_link_tool=np.zeros((4, 4))), "pose")
    refused(lambda: seam.ToolSettings(X_link_tool=np.eye(3)), "(3, 3)", "(4, 4)")
    refused(lambda: seam.Primitive(reference_orientation=[1, 0, 0]), "(3,)", "(4,)")


def test_joins_and_sequences():
    one = seam.learn(movement({"a": 0}, {"a": 1}))
    other = seam.learn(movement({"b": 0}, {"b": 1}))
    task = seam.Sequence().then(one)
    refused(lambda: seam.rollout(task, "dmp9"), "dmp9", "dmp2a")
    refused(lambda: task.then(other), "sequence")
    refused(lambda: task.then(one, until=seam.after_cycles(2)), "discrete")
    assert len(task) == 1  # all of a call or nothing
    refused(lambda: seam.Sequencer(seam.Sequence()), "empty")
    refused(lambda: seam.Sequencer(task, "dmp3", start=[0, 0]), "start", "(2,)", "(1,)")
    refused(lambda: seam.Sequencer(task, "dmp3", start=[np.nan]), "start", "finite")
    refused(lambda: seam.Sequencer(task).step(-1.0), "dt")
    refused(lambda: seam.Sequencer(task).set_goal([1, 2]), "goal", "(2,)")
    refused(lambda: seam.Sequencer(task).join(7), "join 7", error=IndexError)
    refused(lambda: seam.rollout(task, "dmp3", dt=0), "dt", "> 0")
    refused(lambda: seam.rollout(task, "dmp3", dt=1e-9), "rows")
    assert not seam.Sequencer(task).set_goal([np.nan])
    bad = seam.Primitive(coordinates=["a"], goal=[0.0, 1.0])
    refused(lambda: seam.Execution(bad), "primitive")
    refused(lambda: seam.Execution(one).reinitialise([0.0], 2.0), "phase")


def test_controllers(arm, task, q0):
    zeros = np.zeros(7)
    refused(lambda: seam.ArmController(arm, task, q=[0.0]), "q", "(1,)", "(7,)")
    refused(lambda: seam.ArmController(arm, seam.Sequence(), q=q0), "empty")
    refused(lambda: seam.ArmController(arm, task, q=q0, settings=seam.ArmControllerSettings(law=seam.ControlSettings(Kp=[1, 2]))),
            "2")
    control = seam.ArmController(arm, task, q=q0)
    refused(lambda: control.tick(0.0, q0, zeros), "dt")
    refused(lambda: control.tick(1e-3, q0[:6], zeros), "q", "(6,)")
    refused(lambda: control.tick(1e-3, q0, zeros.reshape(7, 1)), "qd", "(7, 1)")
    refused(lambda: control.tick(1e-3, "here", zeros), "q", "numbers")
    refused(lambda: control.tick(1e-3, [None] * 7, zeros), "q", "object")
    for q in (q0.astype(np.float32), q0.astype(">f8"), list(q0), np.repeat(q0, 2)[::2], q0.astype(object).astype(float)):
        assert np.isfinite(control.tick(1e-3, q, np.zeros(7, dtype=int))).all()


def test_a_model_that_was_spoiled(task, q0):
    def spoiled(change):
        model = seam.RobotModel.read(PA10)
        change(model)
        return lambda: seam.ArmController(model, task, q=q0)

    def inertia(model):
        model.bodies[3].inertial.mass = np.nan

    def axis(model):
        model.joints[2].axis = [0, 0, 0]

    def damping(model):
        model.joints[1].damping = -1.0

    refused(spoiled(inertia), '"E1"', "mass")
    refused(spoiled(axis), '"S3"', "axis")
    refused(spoiled(damping), '"S2"', "damping")


def test_what_may_not_be_guessed(arm, task, q0):
    refused(lambda: seam.ArmController(arm, task), "needs q", error=TypeError)
    refused(lambda: seam.ArmController(arm, task, q=q0).set_gravity([np.nan] * 3), "gravity")
    refused(lambda: seam.describe(seam.Incident(cause="deviation"), arm), "joint -1")
    refused(lambda: seam.learn(movement({"a": 0}, {"a": 1}), __class__=seam.Primitive), "__class__", error=TypeError)
    refused(lambda: seam.learn(movement({"a": 0}, {"a": 1}), kind=None), "LearnSettings.kind", error=TypeError)


def test_unaligned_arrays_are_read(arm, task, q0):
    buffer = np.zeros(7 * 8 + 1, dtype=np.uint8)
    odd = buffer[1:].view(np.float64)
    odd[:] = q0
    control = [seam.ArmController(arm, task, q=q0) for _ in range(2)]
    np.testing.assert_array_equal(control[0].tick(1e-3, odd, np.zeros(7)), control[1].tick(1e-3, q0, np.zeros(7)))


def test_a_state_that_is_no_number_is_none(arm, task, q0):
    control = seam.ArmController(arm, task, q=q0)
    for _ in range(20):
        assert np.isfinite(control.tick(1e-3, np.full(7, np.nan), np.zeros(7))).all()
    assert control.status == seam.ArmController.Status.bridging
    for _ in range(300):
        control.tick(1e-3, np.full(7, np.nan), np.zeros(7))
    assert control.status == seam.ArmController.Status.stopped
    assert control.incident.cause == seam.Incident.Cause.no_state
    assert "no state" in control.what_happened() or control.what_happened()


def test_recordings(tmp_path):
    refused(lambda: seam.measure(seam.Recording(joints=["a"], time=[0.0])), "2 ticks")
    refused(lambda: seam.measure(seam.Recording(joints=["a"], time=[0, 1, 2], torque=np.zeros((2, 1)))), "torque", "3 x 1")
    refused(lambda: seam.Recording(time=[0.0]).dt, "2 ticks")
    refused(lambda: seam.jump([0, 1, 2], np.zeros((2, 1)), 1.0), "signal", "3")
    (tmp_path / "empty.csv").write_text("")
    refused(lambda: seam.Recording.read(str(tmp_path / "empty.csv")), "empty.csv")
    refused(lambda: seam.Recording.read(str(tmp_path)), str(tmp_path))


def test_scenes(tmp_path):
    refused(lambda: seam.play("no_such_scene"), "no_such_scene")
    refused(lambda: seam.play("line", spede=2), "spede")
    refused(lambda: seam.play("line", method="dmp7"), "dmp7")
    refused(lambda: seam.play("line", dt=-1.0), "tick")
    refused(lambda: seam.play(seam.Scene.read("line"), speed=2), "Scene.read", error=TypeError)


def test_nothing_is_made_of_what_only_the_library_makes():
    for kind in (seam.RobotModel, seam.Scene, seam.NoJump):
        with pytest.raises(TypeError):
            kind()


def test_the_end_of_the_interpreter_is_quiet(tmp_path):
    """Views outlive their owners, and objects the module."""
    code = ("import seam, numpy as np\nt = np.linspace(0, 1, 101)\n"
            "d = seam.Demonstration(t, {'a': t}); p = d.position; del d\nimport builtins; builtins.kept = (p, seam.learn(seam.Demonstration(t, t)))")
    done = subprocess.run([sys.executable, "-X", "dev", "-c", code], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
