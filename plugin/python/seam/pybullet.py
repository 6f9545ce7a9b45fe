"""Plays a sequence of primitives on an arm in PyBullet.

    import pybullet as p
    import seam, seam.pybullet

    p.connect(p.DIRECT)
    p.setGravity(0, 0, -9.81)
    body = p.loadURDF("arm.urdf", useFixedBase=True, flags=p.URDF_USE_INERTIA_FROM_FILE)
    control = seam.pybullet.attach(body, task, join="dmp3", urdf="arm.urdf")
    while not control.finished:
        control.step()  # control.tick(), then p.stepSimulation()

PyBullet is imported when `attach` needs it, not with this module.
"""

import copy
import functools
import importlib
import logging
import math
import operator
import os
import xml.etree.ElementTree

import numpy as np

import seam

from ._pybullet_body import FIXED, Link, bodies_of, differs, joints_by_name, listed, require_agreement, rotation_matrix, text

__all__ = ["Control", "attach"]

log = logging.getLogger("seam.pybullet")

# PyBullet's numbers, as in its quick-start guide.
_VELOCITY_CONTROL, _TORQUE_CONTROL = 0, 1


def attach(body, task, join="dmp3", *, client=None, urdf=None, model=None, settings=None, joint_damping=0.0,
           inertia="urdf", package_path=()):
    """Takes an arm in PyBullet over, and plays a sequence on it by computed torque.

    It switches the motors of the arm's joints off, sets the body's linear and angular damping to zero and the joints'
    damping to `joint_damping`; `Control.changed` says what it did, and so does the logger "seam.pybullet" (INFO). Joints
    that the sequence does not name hold their position. Joints that PyBullet moves and the model does not have (spherical
    ones, those of links without mass) keep their motors.

    The controller's model must have the mass and the inertia that PyBullet simulates: load the URDF with
    `flags=URDF_USE_INERTIA_FROM_FILE` and `useFixedBase=True`, or see `inertia`. PyBullet simulates neither a URDF's joint friction nor
    what else the model's joints have (rotors, springs), so the controller does not reckon with these either.

    body           unique id, from loadURDF
    task           seam.Sequence, in joint space or in task space (see `settings`)
    join           how primitives are joined: a name, or seam.JoinSettings
    client         None: PyBullet's first client. Or a client's id, a BulletClient, or any other object with PyBullet's calls
    urdf           path of the file that PyBullet loaded. PyBullet does not tell it; without it, attach looks for the one
                   URDF with the body's names in the folders of the body's meshes and above
    model          seam.RobotModel instead of `urdf`
    settings       seam.ArmControllerSettings
    joint_damping  [N m s/rad or N s/m] that the joints keep: one for all, a dict by joint name (others: 0), or "urdf". The
                   controller makes up for it
    inertia        "urdf": mass, centre of mass and inertia must be those of `urdf` or `model`. "pybullet": the controller takes
                   them from PyBullet, whatever they are. Where the joints are must agree in either case
    package_path   folders in which `package://` names of `urdf` are looked for

    Returns a Control.
    Raises seam.Error: the base is not fixed; a joint of the model is missing or of another type; mass, inertia or geometry
    differ from the model's by more than 1e-6; the URDF is not found; PyBullet steps by itself (setRealTimeSimulation); the
    client is not connected; and whatever seam.RobotModel.read and seam.ArmController refuse.
    """
    return Control(_Client(client, body), task, join, urdf, model, settings, joint_damping, inertia,
                   [package_path] if isinstance(package_path, (str, os.PathLike)) else list(package_path))


class Control:
    """A sequence that plays on one body. Made by `attach`.

    Call `tick` once before each stepSimulation: PyBullet adds up the torques of several ticks, and forgets them after the
    step. Torques and forces that the app adds are left alone. For several bodies, `tick` each, then step once. After
    resetSimulation, or when the body was loaded again, attach anew: PyBullet gives its numbers out again.
    """

    def __init__(self, client, task, join, urdf, model, settings, joint_damping, inertia, package_path):
        self._client = client
        self.changed = []
        with client.errors():
            client.require_fixed_base()
            links = client.links()
        if model is None:
            model = self._read(links, urdf, package_path)
        damping = _joint_damping(model, joint_damping)
        model = _without_drives(model)
        self._joints = joints_by_name(client, model, links)
        if inertia == "pybullet":
            self._take_inertia(model, links)
        elif inertia != "urdf":
            raise seam.Error(f'inertia: "{inertia}", must be "urdf" or "pybullet"')
        require_agreement(client, model, links, self._joints)
        self._damping = np.array(damping) if any(damping) else None
        with client.errors():
            self._bind()
            self._world_of_tick()
            self._root_in_world = client.rotation_of_root()
            self._read_state()
        options = {} if settings is None else {"settings": settings}
        #: seam.ArmController
        self.arm = seam.ArmController(model, task, join, q=self._q, qd=self._qd, **options)
        #: [N m or N] sent in the last tick, in the order of the model's joints
        self.torque = np.zeros(model.dof)
        with client.errors():
            self.refresh()
            self._take_over(model, links, damping)

    def tick(self):
        """Reads the joints, advances the sequence by PyBullet's time step, and sends the torques. Gravity and the time
        step may change between ticks.

        Raises seam.Error: the body was removed, the client is disconnected, PyBullet has been told to step by itself or
        in substeps.
        """
        try:
            dt = self._world_of_tick()
            self._read_state()
        except self._client.error as error:
            raise self._client.explain(error) from None
        torque = self.arm.tick(dt, self._q, self._qd)
        if self._damping is not None:
            torque = torque + self._damping * self._qd  # PyBullet takes off just that
        self.torque[:] = torque
        try:
            self._send(forces=self.torque.tolist())
        except self._client.error as error:
            raise self._client.explain(error) from None

    def step(self):
        """`tick`, then stepSimulation of this body's client."""
        self.tick()
        self._step()

    def reinitialise(self):
        """Takes the sequence up again from where the arm is now, after the app has moved it (resetJointState) or has cleared
        up what stopped it. Calls `refresh`. Returns False where the arm cannot go on from there, see seam.ArmController."""
        with self._client.errors():
            self.refresh()
            self._read_state()
        return self.arm.reinitialise(self._q, self._qd)

    def refresh(self):
        """Reads the pose of the base anew, after the app has moved it (resetBasePositionAndOrientation)."""
        with self._client.errors():
            self._client.require_fixed_base()
            self._root_in_world = self._client.rotation_of_root()
            self._gravity = None
            self._world_of_tick()
        self.arm.set_gravity(self._gravity_in_root())

    @property
    def sequencer(self):
        """The sequence as it runs: for changing its goal, tau, amplitude and queue between ticks."""
        return self.arm.sequencer

    @property
    def finished(self):
        """The last switch has been due; the arm stays at the last goal."""
        return self.arm.finished

    @property
    def status(self):
        """Whether the joints do what the sequence says."""
        return self.arm.status

    @property
    def incident(self):
        """What made the arm stop last."""
        return self.arm.incident

    def _read(self, links, urdf, package_path):
        if urdf is None:
            with self._client.errors():
                urdf = _find_urdf(self._client, links)
            self._say(f"URDF: {urdf}")
        return seam.RobotModel.read(os.fspath(urdf), package_path=package_path, leave_out_missing_meshes=True)

    def _bind(self):
        client, n = self._client, len(self._joints)
        self._parameters = client.bound("getPhysicsEngineParameters")
        self._states = client.bound("getJointStates", client.body, self._joints)
        self._send = client.bound("setJointMotorControlArray", client.body, self._joints, _TORQUE_CONTROL)
        self._step = client.bound("stepSimulation")
        self._q, self._qd = np.zeros(n), np.zeros(n)
        self._gravity = None
        self.arm = None

    def _read_state(self):
        self._q[:], self._qd[:], _, _ = zip(*self._states())

    def _world_of_tick(self):
        world = self._parameters()
        if world["useRealTimeSimulation"]:
            raise seam.Error("PyBullet steps by itself: call setRealTimeSimulation(0), and stepSimulation after each tick")
        if world["numSubSteps"] > 1:
            raise seam.Error(f"PyBullet makes {world['numSubSteps']} substeps of one torque: leave numSubSteps at 0, and make "
                             f"the time step smaller")
        gravity = (world["gravityAccelerationX"], world["gravityAccelerationY"], world["gravityAccelerationZ"])
        if gravity != self._gravity:
            self._gravity = gravity
            if self.arm is not None:
                self.arm.set_gravity(self._gravity_in_root())
        return world["fixedTimeStep"]

    def _gravity_in_root(self):
        return self._root_in_world.T @ self._gravity

    def _take_inertia(self, model, links):
        for body, (mass, com, inertia, _) in zip(model.bodies, bodies_of(links, self._joints, model.neutral())):
            if differs(body.inertial, mass, com, inertia):
                self._say(f'link "{body.link}": {mass:.6g} kg, the model\'s {body.inertial.mass:.6g} kg; mass and inertia taken '
                          f"from PyBullet")
                body.inertial = seam.Inertial(mass=mass, com=com, inertia=inertia)

    def _take_over(self, model, links, damping):
        client, moved = self._client, set(self._joints)
        for joint in self._joints:
            client.call("setJointMotorControl2", client.body, joint, _VELOCITY_CONTROL, force=0)
        self._say("motors off: " + listed(joint.name for joint in model.joints))
        client.call("changeDynamics", client.body, -1, linearDamping=0, angularDamping=0)
        self._say("linear and angular damping: 0")
        for i, joint in enumerate(self._joints):
            client.call("changeDynamics", client.body, joint, jointDamping=damping[i])
            self._say(f'joint "{model.joints[i].name}": damping {links[joint].damping:g} when loaded, {damping[i]:g} now')
        for j, link in enumerate(links):
            if link.kind != FIXED and j not in moved:
                self._say(f'joint "{link.joint}": not in the model, keeps its motor')

    def _say(self, line):
        self.changed.append(line)
        log.info("body %d: %s", self._client.body, line)


class _Client:
    """PyBullet's calls for one body of one client."""

    def __init__(self, client, body):
        self.body = body
        if client is None or not hasattr(client, "getJointStates"):
            try:
                self._calls = importlib.import_module("pybullet")
            except ImportError as error:
                raise seam.Error(f"PyBullet is not there: {error}") from None
            self._which = {"physicsClientId": 0 if client is None else operator.index(client)}
        else:
            self._calls, self._which = client, {}
        self.error = getattr(self._calls, "error", RuntimeError)

    def call(self, name, *arguments, **named):
        """One call of PyBullet's API."""
        return getattr(self._calls, name)(*arguments, **named, **self._which)

    def bound(self, name, *arguments):
        """A call that is made often."""
        return functools.partial(getattr(self._calls, name), *arguments, **self._which)

    def errors(self):
        """Context in which PyBullet's errors become seam's."""
        return _Errors(self)

    def explain(self, error):
        """A seam.Error of one line for an error of PyBullet's."""
        if not self.call("isConnected"):
            return seam.Error("the PyBullet client is not connected")
        try:
            bodies = [self.call("getBodyUniqueId", i) for i in range(self.call("getNumBodies"))]
        except self.error:
            bodies = [self.body]
        if self.body not in bodies:
            return seam.Error(f"PyBullet has no body {self.body}: it was removed")
        return seam.Error(f"PyBullet, body {self.body}: {error}")

    def name(self):
        """For messages."""
        return f'PyBullet, body {self.body} ("{text(self.call("getBodyInfo", self.body)[1])}")'

    def require_fixed_base(self):
        # PyBullet: a base is fixed where its mass is 0; useFixedBase makes it so.
        name = self.name()
        mass = self.call("getDynamicsInfo", self.body, -1)[0]
        if mass > 0:
            raise seam.Error(f"{name}: the base is not fixed (mass {mass:g} kg): load it with useFixedBase=True")

    def rotation_of_root(self):
        """Orientation of the URDF's root link in the world, 3 x 3. PyBullet tells that of its centre-of-mass frame."""
        inertial = rotation_matrix(self.call("getDynamicsInfo", self.body, -1)[4])
        return rotation_matrix(self.call("getBasePositionAndOrientation", self.body)[1]) @ inertial.T

    def links(self):
        """Every link but the base."""
        return [Link(self, j) for j in range(self.call("getNumJoints", self.body))]


class _Errors:
    def __init__(self, client):
        self._client = client

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        if kind is not None and issubclass(kind, self._client.error) and not issubclass(kind, seam.Error):
            raise self._client.explain(error) from None
        return False


def _joint_damping(model, wanted):
    """[N m s/rad or N s/m] of each of the model's joints."""
    if isinstance(wanted, str):
        if wanted != "urdf":
            raise seam.Error(f'joint_damping: "{wanted}", must be a number, a dict, or "urdf"')
        damping = [joint.damping for joint in model.joints]
    elif hasattr(wanted, "items"):
        damping = [0.0] * model.dof
        for name, value in wanted.items():
            damping[model.joint(name)] = float(value)
    else:
        damping = [float(wanted)] * model.dof
    for joint, value in zip(model.joints, damping):
        if not 0 <= value < math.inf:
            raise seam.Error(f'joint "{joint.name}": joint_damping {value:g}, must be >= 0')
    return damping


def _without_drives(model):
    """A copy whose joints have what PyBullet simulates."""
    model = copy.copy(model)
    for joint in model.joints:
        joint.damping = joint.friction = joint.rotor_inertia = joint.spring_damping = 0.0
        joint.stiffness = math.inf
    return model


def _find_urdf(client, links):
    """The one URDF with the body's names in the folders of its meshes, and up to three above."""
    base, name = (text(part) for part in client.call("getBodyInfo", client.body))
    wanted = {base} | {link.link for link in links}, {link.joint for link in links if link.kind != FIXED}
    folders = []
    for shape in client.call("getVisualShapeData", client.body):
        folder = os.path.dirname(os.path.abspath(text(shape[4]))) if shape[4] else ""
        for _ in range(4):
            if folder not in folders and os.path.isdir(folder):
                folders.append(folder)
            folder = os.path.dirname(folder)
    found = [path for folder in folders for path in _urdfs(folder) if _has_names(path, name, *wanted)]
    if len(found) == 1:
        return found[0]
    why = "fits more than one file: " + ", ".join(found) if found else "is not among the files near its meshes"
    raise seam.Error(f'PyBullet, body {client.body} ("{name}"): does not tell its URDF, which {why}; pass urdf="PATH"')


def _urdfs(folder):
    return sorted(os.path.join(folder, file) for file in os.listdir(folder) if file.endswith(".urdf"))


def _has_names(path, robot, links, joints):
    try:
        root = xml.etree.ElementTree.parse(path).getroot()
    except (OSError, xml.etree.ElementTree.ParseError):
        return False
    return (root.get("name") == robot and links <= {link.get("name") for link in root.iter("link")} and
            joints <= {joint.get("name") for joint in root.iter("joint")})
