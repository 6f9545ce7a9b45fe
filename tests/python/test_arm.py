"""The controller on an arm that is moved here, in numpy."""

import numpy as np
import pytest

import seam
from conftest import PA10, movement

DT = 1e-3


class Arm:
    """Moves by M(q)·qdd = torque − h(q, qd), both from the inverse dynamics, and semi-implicit steps."""

    def __init__(self, model, q):
        self.dynamics = seam.InverseDynamics(model)
        self.q, self.qd = np.array(q, dtype=float), np.zeros(model.dof)

    def acceleration(self, torque):
        n = self.q.size
        still = np.zeros(n)
        bias = self.dynamics.torque(self.q, self.qd, still)
        weight = self.dynamics.torque(self.q, still, still)
        M = np.column_stack([self.dynamics.torque(self.q, still, unit) - weight for unit in np.eye(n)])
        return np.linalg.solve(M, torque - bias)

    def step(self, torque, dt=DT):
        self.qd = self.qd + dt * self.acceleration(torque)
        self.q = self.q + dt * self.qd


def play(arm, control, ticks, dt=DT):
    """Largest distance from the reference [rad], and the torques."""
    worst, torques = 0.0, []
    for _ in range(ticks):
        torque = control.tick(dt, arm.q, arm.qd)
        worst = max(worst, np.abs(arm.q - control.last_tick.reference.position).max())
        torques.append(torque)
        arm.step(torque, dt)
    return worst, np.array(torques)


@pytest.mark.parametrize("join", ["dmp2", "dmp2a", "dmp3", "dmp2j"])
@pytest.mark.parametrize("dt", [1e-3, 1 / 240])
def test_tracks_at_round_off(arm, task, q0, join, dt):
    control = seam.ArmController(arm, task, join=join, q=q0)
    worst, torques = play(Arm(arm, q0), control, int(1.6 / dt), dt)
    assert control.finished and control.status == seam.ArmController.Status.following
    assert worst < 1e-9
    assert np.ptp(torques[:, 0]) > 1.0  # it does move


def test_torque_steps_with_dmp2_alone(arm, task, q0):
    jumps = {}
    for join in ("dmp2", "dmp3"):
        control = seam.ArmController(arm, task, join=join, q=q0)
        _, torques = play(Arm(arm, q0), control, 900)
        jumps[join] = np.abs(seam.jump(DT * np.arange(900), torques, 0.6)).max()
    assert jumps["dmp2"] > 1.0 and jumps["dmp3"] < 0.02 * jumps["dmp2"]


def test_torques_of_different_ticks_are_different_arrays(arm, task, q0):
    control = seam.ArmController(arm, task, q=q0)
    first = control.tick(DT, q0, np.zeros(7))
    kept = first.copy()
    moved = Arm(arm, q0)
    play(moved, control, 200)
    np.testing.assert_array_equal(first, kept)


def test_a_goal_changes_on_the_way(arm, task, q0):
    control = seam.ArmController(arm, task, join="dmp2a", q=q0)
    moved = Arm(arm, q0)
    play(moved, control, 800)
    goal = q0 + 0.1
    assert control.sequencer.set_goal(goal)
    worst, _ = play(moved, control, 2500)
    assert worst < 1e-9
    np.testing.assert_allclose(moved.q, goal, atol=2e-3)


def test_a_hit_stops_it_and_it_can_be_taken_up_again(arm, task, q0):
    control = seam.ArmController(arm, task, q=q0, settings=seam.ArmControllerSettings(guard=seam.GuardSettings(most_error=0.1)))
    moved = Arm(arm, q0)
    play(moved, control, 300)
    moved.q = moved.q + [0, 0.4, 0, 0, 0, 0, 0]
    play(moved, control, 2)
    assert control.status == seam.ArmController.Status.stopped
    incident = control.incident
    assert incident.cause == seam.Incident.Cause.deviation and arm.joints[incident.joint].name == "S2"
    assert "S2" in control.what_happened() and "\n" not in control.what_happened()
    assert control.reinitialise(moved.q, moved.qd)
    worst, _ = play(moved, control, 3000)
    assert control.status == seam.ArmController.Status.following and worst < 1e-9


def test_gravity_is_that_of_the_base(arm, task, q0):
    control = seam.ArmController(arm, task, q=q0)
    control.set_gravity([0, 0, 0])
    floating = control.tick(DT, q0, np.zeros(7))
    np.testing.assert_allclose(floating, 0.0, atol=0.2)
    assert np.abs(seam.ArmController(arm, task, q=q0).tick(DT, q0, np.zeros(7))).max() > 5.0


def test_friction_that_the_model_knows_is_made_up_for(q0, task):
    known = seam.RobotModel.read(PA10)
    for joint in known.joints:
        joint.damping = 2.0
    bare = seam.ArmController(seam.RobotModel.read(PA10), task, q=q0)
    drives = seam.ArmController(known, task, q=q0)
    state = [seam.ArmController(known, task, q=q0) for _ in range(1)][0]
    state.tick(DT, q0, np.zeros(7))
    velocity = None
    for _ in range(300):
        a, b = bare.tick(DT, q0, np.zeros(7)), drives.tick(DT, q0, np.zeros(7))
        velocity = (b - a) / 2.0
    np.testing.assert_allclose(velocity, drives.last_tick.reference.velocity, atol=2e-2)
    assert np.abs(velocity).max() > 0.05


def test_a_tool_goes_where_its_sequence_says(arm, q0):
    kinematics = seam.Kinematics(arm, arm.frames[-1].name)
    t = np.linspace(0.0, 1.0, 201)
    kinematics.move_to(q0)
    begin = kinematics.X_base_tool[:3, 3]
    path = begin + np.outer(10 * t**3 - 15 * t**4 + 6 * t**5, [0.1, 0.05, -0.1])
    task = seam.Sequence().then(seam.learn(seam.Demonstration(t, path, coordinates=["x", "y", "z"])))
    settings = seam.ArmControllerSettings(tool=seam.ToolSettings(link=arm.frames[-1].name))
    control = seam.ArmController(arm, task, "dmp3", settings, q=q0)
    moved = Arm(arm, q0)
    play(moved, control, 1500)
    assert control.last_tick.tool_error.distance < 1e-9
    np.testing.assert_allclose(kinematics.pose_at(moved.q)[:3, 3], path[-1], atol=5e-3)


def test_kinematics_are_each_others_derivative_and_inverse(arm, q0):
    kinematics = seam.Kinematics(arm, arm.frames[-1].name)
    kinematics.move_to(q0)
    J, h = kinematics.jacobian, 1e-6
    for i, unit in enumerate(np.eye(7)):
        difference = (kinematics.pose_at(q0 + h * unit) - kinematics.pose_at(q0 - h * unit))[:3, 3] / (2 * h)
        np.testing.assert_allclose(J[:3, i], difference, atol=1e-9)
    inverse = seam.InverseKinematics(arm, kinematics, seam.PostureSettings(rest=q0))
    target = kinematics.pose_at(q0 + 0.1)
    found = inverse.reach(target)
    np.testing.assert_allclose(kinematics.pose_at(found), target, atol=1e-9)
    status, solution = inverse.follow(seam.ToolState(target, [0.1, 0, 0, 0, 0, 0]))
    assert status == seam.InverseKinematics.Status.exact
    kinematics.move_to(solution.position)
    np.testing.assert_allclose(kinematics.jacobian @ solution.velocity, [0.1, 0, 0, 0, 0, 0], atol=1e-9)


def test_the_parts_of_a_controller_work_alone(arm, q0):
    actuator = seam.Actuator(arm, seam.ActuatorSettings(lag=0.01))
    actuator.deliver(1e-3, np.zeros(7))
    np.testing.assert_allclose(actuator.deliver(1e-3, np.ones(7)), 1 - np.exp(-0.1), rtol=1e-12)
    sensor = seam.Sensor(arm, seam.SensorSettings(resolution=0.1))
    sensor.measure(1e-3, q0 + 0.04, np.zeros(7))
    np.testing.assert_allclose(sensor.q, q0, atol=1e-12)
    guard = seam.Guard(arm, seam.GuardSettings())
    guard.restart(q0)
    assert guard.trusts(1e-3, q0, np.zeros(7), q0)
    assert guard.deviation(q0 + 1.0, q0, True).cause == seam.Incident.Cause.deviation
    space = seam.JointSpace(arm, ["E1", "W1"])
    assert space.measured(q0, np.zeros(7)).position.tolist() == [q0[3], q0[5]]
    assert space.find([0.2, 0.3]).position[3] == 0.2
    gains = seam.TickGains(400, 40, 1e-3)
    assert gains.Kd == pytest.approx((1 - np.exp(-0.04)) / 1e-3)


def test_a_model_is_looked_over_and_changed(arm):
    assert [joint.name for joint in arm.joints] == ["S1", "S2", "S3", "E1", "E2", "W1", "W2"]
    other = seam.RobotModel.read(PA10)
    body = other.bodies[-1]
    body.inertial = body.inertial + seam.Inertial(2.0, [0, 0, 0.1], np.zeros((3, 3)))
    assert other.bodies[-1].inertial.mass == pytest.approx(arm.bodies[-1].inertial.mass + 2.0)
    assert other.moved_inertia(np.zeros(7))[1] > arm.moved_inertia(np.zeros(7))[1] + 0.5
    joints = other.joints
    del other  # the joints keep it
    joints[0].effort = 12.0
    assert joints[0].effort == 12.0
