"""seam.pybullet on arms in PyBullet, and in what stands in for it where it is not there."""

import logging
import math
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import seam
import seam.pybullet
import stand_in

PA10 = str(pathlib.Path(__file__).parents[2] / "assets" / "pa10" / "pa10.urdf")
ROUND_OFF = 1e-9  # [rad or m]


@pytest.fixture(params=["stand-in", "pybullet"])
def p(request, monkeypatch):
    """The module, with one client connected and the earth's gravity."""
    if request.param == "pybullet":
        module = pytest.importorskip("pybullet", reason="there is no PyBullet: `import pybullet` fails")
    else:
        module = stand_in
        monkeypatch.setitem(sys.modules, "pybullet", stand_in)
    assert module.connect(module.DIRECT) == 0
    module.setGravity(0, 0, -9.81)
    yield module
    for client in range(4):
        if module.isConnected(physicsClientId=client):
            module.disconnect(physicsClientId=client)


def load(p, path, flags=None, useFixedBase=True, **named):
    flags = p.URDF_USE_INERTIA_FROM_FILE if flags is None else flags
    return p.loadURDF(str(path), useFixedBase=useFixedBase, flags=flags, **named)


def task(ends, tau=0.8):
    """Minimum jerk from 0 to `ends` [rad or m] by joint name, and half of the way back before the first has come to rest."""
    s = np.linspace(0, 1, 200)
    rise = 10 * s**3 - 15 * s**4 + 6 * s**5
    out = seam.learn(seam.Demonstration(tau * s, {name: end * rise for name, end in ends.items()}))
    back = seam.learn(seam.Demonstration(tau * s, {name: end * (1 - 0.5 * rise) for name, end in ends.items()}))
    return seam.Sequence().then(out, until=seam.before_end(0.2)).then(back)


PA10_TASK = {"S2": 0.6, "E1": 1.0, "W1": -0.7}


def index_of(p, body, **client):
    """PyBullet's joint indices by name."""
    infos = [p.getJointInfo(body, j, **client) for j in range(p.getNumJoints(body, **client))]
    return {info[1].decode(): info[0] for info in infos}


def positions(p, control, body, **client):
    """[rad or m] in the order of the controller's joints."""
    index = index_of(p, body, **client)
    names = [joint.name for joint in control.arm.model.joints]
    return np.array([state[0] for state in p.getJointStates(body, [index[name] for name in names], **client)])


def off_by(p, control, body, **client):
    """How far the joints are from the reference of the last tick, before the step after it."""
    reference = np.array(control.arm.last_tick.reference.position)
    return np.abs(positions(p, control, body, **client) - reference).max()


def play(p, control, body, ticks, **client):
    """The largest distance from the reference."""
    worst = 0.0
    for _ in range(ticks):
        control.tick()
        worst = max(worst, off_by(p, control, body, **client))
        p.stepSimulation(**client)
    return worst


def play_to_the_end(p, control, body, dt):
    worst = play(p, control, body, int(2.0 / dt))
    assert control.finished
    assert control.status == seam.ArmController.Status.following
    return worst


def joint_position(p, body, name):
    return p.getJointStates(body, [index_of(p, body)[name]])[0][0]


@pytest.mark.parametrize("dt", [1e-3, 1 / 240])
def test_tracks_at_round_off(p, dt):
    p.setTimeStep(dt)
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    assert play_to_the_end(p, control, body, dt) < ROUND_OFF
    for name, end in PA10_TASK.items():
        assert joint_position(p, body, name) == pytest.approx(0.5 * end, abs=0.02)


def test_without_what_attach_does_it_would_not_track(p):
    body = load(p, PA10)
    model = seam.RobotModel.read(PA10, leave_out_missing_meshes=True)
    arm = seam.ArmController(model, task(PA10_TASK), "dmp3", q=model.neutral())
    index = [index_of(p, body)[joint.name] for joint in model.joints]
    worst = 0.0
    for _ in range(240):
        states = p.getJointStates(body, index)
        torque = arm.tick(1 / 240, [state[0] for state in states], [state[1] for state in states])
        worst = max(worst, np.abs(np.array(arm.last_tick.reference.position) - [state[0] for state in states]).max())
        p.setJointMotorControlArray(body, index, p.TORQUE_CONTROL, forces=list(torque))
        p.stepSimulation()
    assert worst > 1e-2


def test_step_is_a_tick_and_a_step(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    for _ in range(100):
        control.step()
    assert control.arm.last_tick.time == pytest.approx(99 / 240)
    assert joint_position(p, body, "E1") > 0.1
    control.tick()
    assert off_by(p, control, body) < ROUND_OFF


def test_sends_what_the_controller_says(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    play(p, control, body, 50)
    assert np.array_equal(control.torque, control.arm.last_tick.torque)
    assert np.abs(control.torque).max() > 10


def test_settings_and_join_reach_the_controller(p):
    body = load(p, PA10)
    settings = seam.ArmControllerSettings(law=seam.ControlSettings(reference="plain"))
    control = seam.pybullet.attach(body, task(PA10_TASK), join="dmp2", urdf=PA10, settings=settings)
    assert 1e-6 < play(p, control, body, 400) < 1e-1
    with pytest.raises(seam.Error):
        seam.pybullet.attach(body, task(PA10_TASK), join="no such join", urdf=PA10)


# Robots of boxes: by hand, so that each has what a test is about.


def link(name, mass=1.0, com="0.1 0 0", inertia=(0.02, 0.03, 0.04), rpy="0 0 0"):
    xx, yy, zz = inertia
    return (f'<link name="{name}"><inertial><origin xyz="{com}" rpy="{rpy}"/><mass value="{mass}"/><inertia ixx="{xx}" iyy="{yy}" '
            f'izz="{zz}" ixy="0" ixz="0" iyz="0"/></inertial><collision><origin xyz="{com}"/><geometry><box size="0.2 0.1 0.05"/>'
            f"</geometry></collision></link>")


def joint(name, parent, child, kind="revolute", xyz="0.2 0 0", axis="0 1 0", more=""):
    limit = '<limit lower="-3" upper="3" effort="500" velocity="20"/>' if kind != "fixed" else ""
    return (f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{xyz}" '
            f'rpy="0.1 0.2 0.3"/><axis xyz="{axis}"/>{limit}{more}</joint>')


def write(path, *elements, name="robot"):
    path.write_text(f'<robot name="{name}">{"".join(elements)}</robot>')
    return path


def wheel(path, damping=0.0):
    """One joint about the vertical, with 0.04 kg m2."""
    return write(path, link("base"), link("rim", com="0 0 0"),
                 f'<joint name="turn" type="continuous"><parent link="base"/><child link="rim"/><axis xyz="0 0 1"/>'
                 f'<dynamics damping="{damping}" friction="3"/></joint>')


def tree(path):
    """Two branches, with a link fixed between. Its links stand in the file in another order than its joints."""
    return write(path, link("base"), link("a1"), link("hand", mass=0.3), link("a2"), link("a3"), link("b1"), link("b2"),
                 joint("a2", "hand", "a2", axis="0 0 1"), joint("b1", "base", "b1", xyz="-0.2 0 0", axis="0 0 1"),
                 joint("a3", "a2", "a3", kind="prismatic", axis="1 0 0"), joint("wrist", "a1", "hand", kind="fixed"),
                 joint("b2", "b1", "b2", axis="0.6 0 0.8"), joint("a1", "base", "a1"))


@pytest.mark.parametrize("in_the_order_of_the_file", [False, True])
def test_joints_go_by_name(p, tmp_path, in_the_order_of_the_file):
    path = tree(tmp_path / "tree.urdf")
    flags = p.URDF_USE_INERTIA_FROM_FILE | (p.URDF_MAINTAIN_LINK_ORDER if in_the_order_of_the_file else 0)
    body = load(p, path, flags)
    control = seam.pybullet.attach(body, task({"a3": 0.2, "b1": 0.7, "a1": -0.5}), urdf=path)
    order = [joint.name for joint in control.arm.model.joints]
    assert in_the_order_of_the_file == (order != [name for name in index_of(p, body) if name != "wrist"])
    assert sorted(index_of(p, body)[name] for name in order) != list(range(5))
    assert play_to_the_end(p, control, body, 1 / 240) < ROUND_OFF
    assert joint_position(p, body, "b1") == pytest.approx(0.35, abs=0.02)
    assert joint_position(p, body, "a3") == pytest.approx(0.1, abs=0.02)


def test_joints_that_are_not_named_hold(p, tmp_path):
    path = tree(tmp_path / "tree.urdf")
    body = load(p, path)
    index = index_of(p, body)
    p.resetJointState(body, index["a2"], 0.4)
    p.resetJointState(body, index["b2"], -0.3)
    control = seam.pybullet.attach(body, task({"a1": 0.5}), urdf=path)
    play(p, control, body, 480)
    assert joint_position(p, body, "a2") == pytest.approx(0.4, abs=ROUND_OFF)
    assert joint_position(p, body, "b2") == pytest.approx(-0.3, abs=ROUND_OFF)


def test_a_follower_goes_where_its_leader_has_it(p, tmp_path):
    path = write(tmp_path / "gripper.urdf", link("base"), link("palm"), link("left"), link("right"), joint("arm", "base", "palm"),
                 joint("left", "palm", "left", kind="prismatic", axis="0 1 0"),
                 joint("right", "palm", "right", kind="prismatic", axis="0 -1 0", more='<mimic joint="left" multiplier="0.5"/>'))
    body = load(p, path)
    control = seam.pybullet.attach(body, task({"left": 0.1, "arm": 0.6}), urdf=path)
    assert play_to_the_end(p, control, body, 1 / 240) < ROUND_OFF
    assert joint_position(p, body, "left") == pytest.approx(0.05, abs=0.01)
    assert joint_position(p, body, "right") == pytest.approx(0.5 * joint_position(p, body, "left"), abs=1e-6)


def test_several_bodies_of_one_client(p):
    bodies = [load(p, PA10), load(p, PA10, basePosition=[3, 0, 0])]
    tasks = [task(PA10_TASK), task({"E1": -1.0, "W1": 0.4})]
    controls = [seam.pybullet.attach(body, each, urdf=PA10) for body, each in zip(bodies, tasks)]
    for _ in range(480):
        for control, body in zip(controls, bodies):
            control.tick()
            assert off_by(p, control, body) < ROUND_OFF
        p.stepSimulation()
    assert joint_position(p, bodies[0], "E1") == pytest.approx(0.5, abs=0.02)
    assert joint_position(p, bodies[1], "E1") == pytest.approx(-0.5, abs=0.02)


def test_several_clients(p):
    other = p.connect(p.DIRECT)
    wrapped = stand_in.BulletClient(p)
    controls = []
    for client, number, dt in ((None, 0, 1e-3), (other, other, 2e-3), (wrapped, wrapped._client, 1 / 240)):
        p.setGravity(0, 0, -9.81, physicsClientId=number)
        p.setTimeStep(dt, physicsClientId=number)
        body = load(p, PA10, physicsClientId=number)
        controls.append((seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10, client=client), body, number))
    assert {body for _, body, _ in controls} == {0}
    for control, body, number in controls:
        assert play(p, control, body, 100, physicsClientId=number) < ROUND_OFF
    times = [control.arm.last_tick.time for control, _, _ in controls]
    assert times == pytest.approx([0.099, 0.198, 99 / 240])
    p.disconnect(physicsClientId=other)
    controls[0][0].step()
    controls[2][0].step()
    with pytest.raises(seam.Error, match="not connected"):
        controls[1][0].step()


def test_a_base_that_floats_is_refused(p):
    body = load(p, PA10, useFixedBase=False)
    with pytest.raises(seam.Error, match=r"base is not fixed \(mass 3.04 kg\): load it with useFixedBase=True"):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)


def test_inertia_that_is_not_the_files_is_refused(p):
    body = load(p, PA10, flags=0)
    with pytest.raises(seam.Error, match='inertia of link "S1_link".*URDF_USE_INERTIA_FROM_FILE'):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)


def test_a_scale_is_refused(p):
    body = load(p, PA10, globalScaling=1.2)
    with pytest.raises(seam.Error, match="scaled by 1.2.*globalScaling"):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)


def test_a_mass_that_was_changed_is_refused(p):
    body = load(p, PA10)
    seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    p.changeDynamics(body, index_of(p, body)["E2"], mass=3.5)
    with pytest.raises(seam.Error, match='mass of link "E2_link" is 3.5 kg, in the model 3.45 kg'):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)


def test_a_mass_that_is_fixed_to_a_link_is_named(p):
    body = load(p, PA10)
    p.changeDynamics(body, index_of(p, body)["flange"], mass=2.0)
    with pytest.raises(seam.Error, match='mass of link "W2_link", with "hand", "tool" fixed to it, is 2.24 kg, in the model 1.44'):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)


def test_links_without_inertial_are_named(p, tmp_path):
    path = write(tmp_path / "tool.urdf", link("base"), link("arm"), '<link name="tool0"/>', joint("turn", "base", "arm"),
                 joint("tool", "arm", "tool0", kind="fixed"))
    body = load(p, path)
    with pytest.raises(seam.Error, match='"tool0" weighs 1 kg in PyBullet, as any link without <inertial>'):
        seam.pybullet.attach(body, task({"turn": 1.0}), urdf=path)
    control = seam.pybullet.attach(body, task({"turn": 1.0}), urdf=path, inertia="pybullet")
    assert play_to_the_end(p, control, body, 1 / 240) < ROUND_OFF


def test_another_geometry_is_refused(p, tmp_path):
    path = write(tmp_path / "long.urdf", link("base"), link("a"), link("b"), joint("a", "base", "a"), joint("b", "a", "b"))
    other = write(tmp_path / "short.urdf", link("base"), link("a"), link("b"), joint("a", "base", "a"),
                  joint("b", "a", "b", xyz="0.1999 0 0"))
    body = load(p, path)
    with pytest.raises(seam.Error, match="joints are elsewhere"):
        seam.pybullet.attach(body, task({"a": 1.0}), urdf=other)


def test_an_axis_that_is_no_unit_vector_is_named(p, tmp_path):
    path = write(tmp_path / "skew.urdf", link("base"), link("a"), joint("a", "base", "a", axis="1 0 1"))
    body = load(p, path)
    with pytest.raises(seam.Error, match='axis of joint "a" has length 1.41421356'):
        seam.pybullet.attach(body, task({"a": 1.0}), urdf=path)


def test_links_before_their_parents_are_refused(p, tmp_path):
    path = write(tmp_path / "late.urdf", link("base"), link("b"), link("a"), joint("a", "base", "a"), joint("b", "a", "b"))
    body = load(p, path, p.URDF_USE_INERTIA_FROM_FILE | p.URDF_MAINTAIN_LINK_ORDER)
    with pytest.raises(seam.Error, match='link "b" comes before its parent'):
        seam.pybullet.attach(body, task({"a": 1.0}), urdf=path)


def test_joints_that_pybullet_lacks_are_named(p, tmp_path):
    path = write(tmp_path / "one.urdf", link("base"), link("a"), joint("a", "base", "a"))
    body = load(p, path)
    with pytest.raises(seam.Error, match='no joint "S1" of the model among "a"'):
        seam.pybullet.attach(body, task({"a": 1.0}), urdf=PA10)


def test_inertia_can_be_taken_from_pybullet(p):
    body = load(p, PA10, flags=0)
    p.changeDynamics(body, index_of(p, body)["flange"], mass=3.0)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10, inertia="pybullet")
    assert any("W2_link" in line and "taken from PyBullet" in line for line in control.changed)
    assert play_to_the_end(p, control, body, 1 / 240) < ROUND_OFF


def test_a_model_instead_of_a_file_is_left_as_it_is(p, tmp_path):
    path = wheel(tmp_path / "wheel.urdf", damping=0.5)
    model = seam.RobotModel.read(str(path))
    body = load(p, path)
    control = seam.pybullet.attach(body, task({"turn": 1.0}), model=model)
    assert play_to_the_end(p, control, body, 1 / 240) < ROUND_OFF
    assert (model.joints[0].damping, model.joints[0].friction) == (0.5, 3.0)


def test_motors_and_damping_are_off(p, tmp_path):
    path = wheel(tmp_path / "wheel.urdf", damping=0.5)
    body, free = load(p, path), load(p, path, basePosition=[3, 0, 0])
    turn = index_of(p, body)["turn"]
    seam.pybullet.attach(free, task({"turn": 1.0}), urdf=path)
    for each in (body, free):
        p.resetJointState(each, turn, 0.0, 2.0)
    for _ in range(240):
        p.stepSimulation()
    assert abs(p.getJointStates(body, [turn])[0][1]) < 1e-3
    assert p.getJointStates(free, [turn])[0][1] == pytest.approx(2.0, abs=1e-12)


@pytest.mark.parametrize("damping, kept", [(0.3, 0.3), ({"turn": 0.2}, 0.2), ("urdf", 0.5)])
def test_damping_that_is_kept_is_there_and_made_up_for(p, tmp_path, damping, kept):
    path = wheel(tmp_path / "wheel.urdf", damping=0.5)
    body = load(p, path)
    control = seam.pybullet.attach(body, task({"turn": 1.0}), urdf=path, joint_damping=damping)
    assert play_to_the_end(p, control, body, 1 / 240) < ROUND_OFF
    p.resetJointState(body, 0, 0.0, 2.0)
    for _ in range(10):
        p.stepSimulation()
    assert p.getJointStates(body, [0])[0][1] == pytest.approx(2.0 * (1 - kept / 0.04 / 240)**10, rel=1e-9)


@pytest.mark.parametrize("damping", [-1.0, math.nan, "all", {"no such joint": 1.0}])
def test_damping_that_cannot_be_is_refused(p, damping):
    body = load(p, PA10)
    with pytest.raises(seam.Error, match="joint"):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10, joint_damping=damping)


def test_says_what_it_changed(p, tmp_path, caplog):
    path = wheel(tmp_path / "wheel.urdf", damping=0.5)
    body = load(p, path)
    with caplog.at_level(logging.INFO, "seam.pybullet"):
        control = seam.pybullet.attach(body, task({"turn": 1.0}), urdf=path)
    assert control.changed == ['motors off: "turn"', "linear and angular damping: 0",
                               'joint "turn": damping 0.5 when loaded, 0 now']
    assert [record.getMessage() for record in caplog.records] == [f"body {body}: {line}" for line in control.changed]


def test_the_time_step_may_change(p):
    p.setTimeStep(1e-3)
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    assert play(p, control, body, 300) < ROUND_OFF
    p.setTimeStep(2e-3)
    assert play(p, control, body, 300) < 1e-4
    assert control.arm.last_tick.time == pytest.approx(0.3 + 0.299 * 2)
    play(p, control, body, 1000)
    assert play(p, control, body, 10) < ROUND_OFF


def test_a_tilted_base_and_another_gravity(p):
    p.setGravity(1.0, -2.0, -5.0)
    body = load(p, PA10, basePosition=[1, 2, 3], baseOrientation=p.getQuaternionFromEuler([0.5, -0.8, 1.0]))
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    assert play(p, control, body, 120) < ROUND_OFF
    p.setGravity(0.0, 3.0, 8.0)
    assert play(p, control, body, 120) < ROUND_OFF


def test_without_gravity(p):
    p.setGravity(0, 0, 0)
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    assert play(p, control, body, 120) < ROUND_OFF


def test_a_base_whose_inertia_lies_askew(p, tmp_path):
    path = write(tmp_path / "askew.urdf", link("base", com="0.3 0.2 0.1", rpy="0.7 -0.4 1.1"), link("a", rpy="0.3 0.5 0.7"), link("b"),
                 joint("a", "base", "a"), joint("b", "a", "b"))
    body = load(p, path, baseOrientation=p.getQuaternionFromEuler([0.2, 0.3, 0.4]))
    control = seam.pybullet.attach(body, task({"a": 0.8}), urdf=path)
    assert play_to_the_end(p, control, body, 1 / 240) < ROUND_OFF


def test_a_base_that_was_moved(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    play(p, control, body, 50)
    p.resetBasePositionAndOrientation(body, [0, 0, 1], p.getQuaternionFromEuler([1.2, 0.0, 0.0]))
    control.refresh()
    assert play(p, control, body, 100) < ROUND_OFF


def test_goes_on_after_the_arm_was_moved(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    play(p, control, body, 50)
    p.resetJointState(body, index_of(p, body)["E1"], 0.9)
    p.resetJointState(body, index_of(p, body)["S3"], 0.2)
    assert control.reinitialise()
    play(p, control, body, 480)
    assert control.status == seam.ArmController.Status.following
    assert joint_position(p, body, "E1") == pytest.approx(0.5, abs=0.03)
    assert joint_position(p, body, "S3") == pytest.approx(0.2, abs=ROUND_OFF)


def test_a_hit_stops_the_arm_and_says_so(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    play(p, control, body, 20)
    p.resetJointState(body, index_of(p, body)["E1"], 1.5)
    play(p, control, body, 50)
    assert control.status == seam.ArmController.Status.stopped
    assert "E1" in control.arm.what_happened()


def test_a_body_that_is_gone(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    control.step()
    p.removeBody(body)
    for call in (control.tick, control.step, control.refresh, control.reinitialise):
        with pytest.raises(seam.Error, match=f"no body {body}: it was removed"):
            call()
    with pytest.raises(seam.Error, match=f"no body {body}"):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)


def test_a_client_that_is_gone(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    p.disconnect()
    for call in (control.tick, control.step, control.refresh, control.reinitialise):
        with pytest.raises(seam.Error, match="not connected"):
            call()
    with pytest.raises(seam.Error, match="not connected"):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)


def test_steps_that_are_not_its_own_are_refused(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    p.setPhysicsEngineParameter(numSubSteps=4)
    with pytest.raises(seam.Error, match="4 substeps"):
        control.tick()
    p.setPhysicsEngineParameter(numSubSteps=0)
    p.setRealTimeSimulation(1)
    with pytest.raises(seam.Error, match="steps by itself"):
        seam.pybullet.attach(body, task(PA10_TASK), urdf=PA10)
    p.setRealTimeSimulation(0)
    control.tick()


def test_finds_the_urdf_near_its_meshes(p):
    body = load(p, PA10)
    control = seam.pybullet.attach(body, task(PA10_TASK))
    assert control.changed[0] == f"URDF: {PA10}"
    assert play(p, control, body, 100) < ROUND_OFF


def test_asks_for_the_urdf_that_it_cannot_find(p, tmp_path):
    body = load(p, wheel(tmp_path / "wheel.urdf"))
    with pytest.raises(seam.Error, match='pass urdf="PATH"'):
        seam.pybullet.attach(body, task({"turn": 1.0}))
    with pytest.raises(seam.Error, match="no_such.urdf"):
        seam.pybullet.attach(body, task({"turn": 1.0}), urdf=tmp_path / "no_such.urdf")


def test_what_the_sequence_asks_for_must_be_there(p):
    body = load(p, PA10)
    with pytest.raises(seam.Error, match="elbow"):
        seam.pybullet.attach(body, task({"elbow": 1.0}), urdf=PA10)
    assert joint_position(p, body, "E1") == 0.0
    for _ in range(50):
        p.stepSimulation()
    assert abs(joint_position(p, body, "E1")) < 0.05  # the motors hold as before


def test_pybullet_is_imported_by_attach_alone():
    program = "import sys, seam.pybullet\nassert 'pybullet' not in sys.modules"
    subprocess.run([sys.executable, "-c", program], check=True)


def test_without_pybullet_attach_says_so(monkeypatch):
    monkeypatch.setitem(sys.modules, "pybullet", None)
    with pytest.raises(seam.Error, match="PyBullet is not there"):
        seam.pybullet.attach(0, task(PA10_TASK), urdf=PA10)
