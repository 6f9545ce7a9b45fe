"""Stands in for the module `pybullet` where that is not there.

It has the calls that seam.pybullet and its tests make, with PyBullet's argument names, indices, tuples and errors, on a Bullet
world of the tests' own (seam_test_world). As in PyBullet, fixed joints are counted, links come depth first, motors hold from
the beginning, bodies are damped, torques last for one step, and a link's inertia is the file's only where
URDF_USE_INERTIA_FROM_FILE says so. What it cannot do: contacts, joint limits, bases that move, position control.
"""

import functools
import itertools
import os
import tempfile
import xml.etree.ElementTree as ElementTree

import numpy as np

import seam_test_world

DIRECT = 2
VELOCITY_CONTROL, TORQUE_CONTROL = 0, 1
JOINT_REVOLUTE, JOINT_PRISMATIC, JOINT_SPHERICAL, JOINT_PLANAR, JOINT_FIXED = range(5)
URDF_USE_INERTIA_FROM_FILE = 2
URDF_MAINTAIN_LINK_ORDER = 131072

_KINDS = {"revolute": JOINT_REVOLUTE, "continuous": JOINT_REVOLUTE, "prismatic": JOINT_PRISMATIC, "fixed": JOINT_FIXED}
_clients = {}


class error(Exception):
    """pybullet.error"""


def connect(method, **unused):
    number = next(i for i in itertools.count() if i not in _clients)
    _clients[number] = _Client()
    return number


def disconnect(physicsClientId=0):
    _client(physicsClientId)
    del _clients[physicsClientId]


def isConnected(physicsClientId=0):
    return int(physicsClientId in _clients)


def getQuaternionFromEuler(eulerAngles, physicsClientId=0):
    return tuple(_quaternion(_rpy(eulerAngles)))


class BulletClient:
    """As pybullet_utils.bullet_client.BulletClient."""

    def __init__(self, module, connection_mode=DIRECT):
        self._module, self._client = module, module.connect(connection_mode)

    def __getattr__(self, name):
        attribute = getattr(self._module, name)
        if callable(attribute) and not isinstance(attribute, type):
            return functools.partial(attribute, physicsClientId=self._client)
        return attribute


def _client(number):
    if number not in _clients:
        raise error("Not connected to physics server.")
    return _clients[number]


def _of_client(call):
    """A call of the module: that of the client which physicsClientId names."""

    @functools.wraps(call)
    def of_module(*arguments, physicsClientId=0, **named):
        return call(_client(physicsClientId), *arguments, **named)

    return of_module


class _Client:
    def __init__(self):
        self.world = seam_test_world.World()
        self.bodies = {}
        self.count = 0
        self.dt, self.substeps, self.real_time = 1 / 240, 0, 0
        self.gravity = (0.0, 0.0, 0.0)
        self.world.set_gravity(self.gravity)

    def body(self, number, message):
        if number not in self.bodies:
            raise error(message)
        return self.bodies[number]


@_of_client
def setGravity(client, gravX, gravY, gravZ):
    client.gravity = (float(gravX), float(gravY), float(gravZ))
    client.world.set_gravity(client.gravity)


@_of_client
def setTimeStep(client, timeStep):
    client.dt = timeStep


@_of_client
def setRealTimeSimulation(client, enableRealTimeSimulation):
    client.real_time = enableRealTimeSimulation


@_of_client
def setPhysicsEngineParameter(client, fixedTimeStep=None, numSubSteps=None):
    client.dt = client.dt if fixedTimeStep is None else fixedTimeStep
    client.substeps = client.substeps if numSubSteps is None else numSubSteps


@_of_client
def getPhysicsEngineParameters(client):
    x, y, z = client.gravity
    return {"fixedTimeStep": client.dt, "numSubSteps": client.substeps, "numSolverIterations": 50,
            "useRealTimeSimulation": client.real_time, "gravityAccelerationX": x, "gravityAccelerationY": y,
            "gravityAccelerationZ": z, "numNonContactInnerIterations": 1}


@_of_client
def loadURDF(client, fileName, basePosition=(0, 0, 0), baseOrientation=(0, 0, 0, 1), useMaximalCoordinates=0, useFixedBase=0,
             flags=0, globalScaling=1.0):
    if not os.path.isfile(fileName):
        raise error("Cannot load URDF file.")
    number, client.count = client.count, client.count + 1
    client.bodies[number] = _Body(client, fileName, basePosition, baseOrientation, useFixedBase, flags, globalScaling)
    return number


@_of_client
def removeBody(client, bodyUniqueId):
    if bodyUniqueId in client.bodies:
        client.world.remove(client.bodies.pop(bodyUniqueId).number)


@_of_client
def getNumBodies(client):
    return len(client.bodies)


@_of_client
def getBodyUniqueId(client, serialIndex):
    return list(client.bodies)[serialIndex]


@_of_client
def getBodyInfo(client, bodyUniqueId):
    body = client.body(bodyUniqueId, "Couldn't get body info")
    return body.base.name.encode(), body.name.encode()


@_of_client
def getNumJoints(client, bodyUniqueId):
    return len(client.bodies[bodyUniqueId].links) if bodyUniqueId in client.bodies else 0


@_of_client
def getJointInfo(client, bodyUniqueId, jointIndex):
    body = client.body(bodyUniqueId, "GetJointInfo failed.")
    if not 0 <= jointIndex < len(body.links):
        raise error("GetJointInfo failed.")
    link, moving = body.links[jointIndex], body.moving()
    above = body.links[link.parent] if link.parent >= 0 else body.base
    pivot = above.frame.T @ (link.origin - above.com)
    turn = link.frame.T @ link.rotation.T @ above.frame  # of vectors, from the parent's frame to this one
    place = moving.index(link) if link in moving else None
    return (jointIndex, link.joint.encode(), link.kind, -1 if place is None else 7 + place, -1 if place is None else 6 + place,
            int(place is not None), link.damping_in_file, link.friction, *link.limits, link.name.encode(),
            tuple(link.frame.T @ link.axis) if place is not None else (0.0, 0.0, 0.0), tuple(pivot),
            tuple(_quaternion(turn)), link.parent)


@_of_client
def getDynamicsInfo(client, bodyUniqueId, linkIndex):
    body = client.body(bodyUniqueId, "getDynamicsInfo failed; invalid return status")
    link = body.base if linkIndex == -1 else body.links[linkIndex]
    return (link.mass, 0.5, tuple(link.inertia), tuple(link.com), tuple(_quaternion(link.frame)), 0.0, 0.0, 0.0, -1.0, -1.0, 2,
            0.001)


@_of_client
def changeDynamics(client, bodyUniqueId, linkIndex, mass=None, linearDamping=None, angularDamping=None, jointDamping=None,
                   localInertiaDiagonal=None):
    if bodyUniqueId not in client.bodies:
        return
    body = client.bodies[bodyUniqueId]
    link = body.base if linkIndex == -1 else body.links[linkIndex]
    body.linear_damping = body.linear_damping if linearDamping is None else linearDamping
    body.angular_damping = body.angular_damping if angularDamping is None else angularDamping
    client.world.set_damping(body.number, body.linear_damping, body.angular_damping)
    if jointDamping is not None:
        link.damping = jointDamping
    if mass is not None:
        link.mass, link.inertia = mass, _of_shape(mass)
    if localInertiaDiagonal is not None:
        link.inertia = np.array(localInertiaDiagonal)
    if mass is not None or localInertiaDiagonal is not None:
        body.rebuild()


@_of_client
def getBasePositionAndOrientation(client, bodyUniqueId):
    body = client.body(bodyUniqueId, "GetBasePositionAndOrientation failed.")
    return tuple(body.position + body.rotation @ body.base.com), tuple(_quaternion(body.rotation @ body.base.frame))


@_of_client
def resetBasePositionAndOrientation(client, bodyUniqueId, posObj, ornObj):
    body = client.bodies[bodyUniqueId]
    body.rotation = _matrix(ornObj) @ body.base.frame.T
    body.position = np.array(posObj, float) - body.rotation @ body.base.com
    body.rebuild()


@_of_client
def getVisualShapeData(client, objectUniqueId):
    body = client.bodies.get(objectUniqueId)
    return tuple((objectUniqueId, -1, 5, (1.0, 1.0, 1.0), mesh.encode(), (0.0,) * 3, (0.0, 0.0, 0.0, 1.0), (1.0,) * 4)
                 for mesh in (body.meshes if body else []))


@_of_client
def getJointStates(client, bodyUniqueId, jointIndices):
    body = client.body(bodyUniqueId, "getJointState failed.")
    q, qd = client.world.state(body.number)
    return tuple(_state(body, q, qd, j) for j in jointIndices)


def _state(body, q, qd, j):
    if not 0 <= j < len(body.links):
        raise error("Joint index out-of-range.")
    i = body.index.get(j)
    return (0.0, 0.0, (0.0,) * 6, 0.0) if i is None else (float(q[i]), float(qd[i]), (0.0,) * 6, 0.0)


@_of_client
def resetJointState(client, bodyUniqueId, jointIndex, targetValue, targetVelocity=0.0):
    body = client.body(bodyUniqueId, "Joint index out-of-range.")
    q, qd = client.world.state(body.number)
    q[body.index[jointIndex]], qd[body.index[jointIndex]] = targetValue, targetVelocity
    client.world.reset(body.number, q, qd)


@_of_client
def setJointMotorControl2(client, bodyUniqueId, jointIndex, controlMode, targetVelocity=0.0, force=100000.0):
    _control(client, bodyUniqueId, [jointIndex], controlMode, [force])


@_of_client
def setJointMotorControlArray(client, bodyUniqueId, jointIndices, controlMode, targetPositions=None, targetVelocities=None,
                              forces=None):
    if len(forces) != len(jointIndices):
        raise error("number of forces should match the joint indices")
    _control(client, bodyUniqueId, jointIndices, controlMode, forces)


def _control(client, number, joints, mode, forces):
    body = client.body(number, "Joint index out-of-range.")
    for j, force in zip(joints, forces):
        if not 0 <= j < len(body.links):
            raise error("Joint index out-of-range.")
        if mode == TORQUE_CONTROL:
            client.world.add_torque(body.number, body.index[j], force)
        elif mode == VELOCITY_CONTROL:
            body.links[j].motor = force * client.dt
            client.world.hold(body.number, body.index[j], body.links[j].motor)
        else:
            raise NotImplementedError("position control")


@_of_client
def stepSimulation(client):
    for body in client.bodies.values():
        qd = client.world.state(body.number)[1]
        for j, i in body.index.items():
            client.world.add_torque(body.number, i, -body.links[j].damping * qd[i])
    client.world.step(client.dt, client.substeps)


class _Link:
    """A link and the joint that moves it, as PyBullet takes them from a file."""

    def __init__(self, element, from_file, scale):
        self.name = element.get("name")
        inertial = element.find("inertial")
        if inertial is None:
            self.mass, self.com, self.frame = (0.0 if self.name == "world" else 1.0), np.zeros(3), np.eye(3)
            self.inertia = np.full(3, self.mass)
        else:
            self.mass = float(inertial.find("mass").get("value"))
            origin, self.frame = _origin(inertial)
            self.com = scale * origin
            self._read_inertia(inertial.find("inertia"))
        if not from_file:
            self.inertia = _of_shape(self.mass)
        self.joint, self.kind, self.parent = "", JOINT_FIXED, -1
        self.origin, self.rotation, self.axis = np.zeros(3), np.eye(3), np.zeros(3)
        self.damping = self.damping_in_file = self.friction = 0.0
        self.limits = (0.0, -1.0, 0.0, 0.0)
        self.type, self.motor = "fixed", 1.0

    def _read_inertia(self, element):
        xx, yy, zz, xy, xz, yz = (float(element.get(name, 0)) for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
        if xy == xz == yz == 0:
            self.inertia = np.array([xx, yy, zz])
            return
        self.inertia, axes = np.linalg.eigh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
        self.frame = self.frame @ (axes * np.sign(np.linalg.det(axes)))

    def be_moved_by(self, element, parent, scale):
        """The joint of a file that leads here."""
        self.joint, self.type, self.parent = element.get("name"), element.get("type"), parent
        self.kind = _KINDS[self.type]
        origin, self.rotation = _origin(element)
        self.origin = scale * origin
        axis = element.find("axis")
        self.axis = _numbers(axis.get("xyz")) if axis is not None else np.array([1.0, 0.0, 0.0])
        dynamics, limit = element.find("dynamics"), element.find("limit")
        if dynamics is not None:
            self.damping = self.damping_in_file = float(dynamics.get("damping", 0))
            self.friction = float(dynamics.get("friction", 0))
        if limit is not None:
            self.limits = tuple(float(limit.get(name, 0)) for name in ("lower", "upper", "effort", "velocity"))


class _Body:
    def __init__(self, client, path, position, quaternion, fixed, flags, scale):
        root = ElementTree.parse(path).getroot()
        self.world, self.name = client.world, root.get("name")
        from_file = bool(flags & URDF_USE_INERTIA_FROM_FILE)
        links = {element.get("name"): _Link(element, from_file, scale) for element in root.findall("link")}
        joints = root.findall("joint")
        children = {joint.find("child").get("link") for joint in joints}
        self.base = next(link for name, link in links.items() if name not in children)
        if fixed:
            self.base.mass, self.base.inertia = 0.0, np.zeros(3)
        self.links = []
        self._collect(self.base, -1, joints, links, scale)
        if flags & URDF_MAINTAIN_LINK_ORDER:
            self._sort(list(links))
        self.position, self.rotation = np.array(position, float), _matrix(quaternion)
        folder = os.path.dirname(os.path.abspath(path))
        self.meshes = [os.path.join(folder, mesh.get("filename").split("://")[-1]) for mesh in root.iter("mesh")]
        self.linear_damping = self.angular_damping = 0.04
        self._build()

    def _collect(self, above, parent, joints, links, scale):
        for joint in joints:
            if joint.find("parent").get("link") == above.name:
                link = links[joint.find("child").get("link")]
                link.be_moved_by(joint, parent, scale)
                self.links.append(link)
                self._collect(link, len(self.links) - 1, joints, links, scale)

    def _sort(self, names):
        above = {link.name: self.links[link.parent].name for link in self.links if link.parent >= 0}
        self.links.sort(key=lambda link: names.index(link.name))
        index = {link.name: j for j, link in enumerate(self.links)}
        for link in self.links:
            link.parent = index[above[link.name]] if link.name in above else -1

    def moving(self):
        return [link for link in self.links if link.kind != JOINT_FIXED]

    def rebuild(self):
        """After a mass has changed, or the base was moved."""
        state = self.world.state(self.number)
        self.world.remove(self.number)
        self._build()
        self.world.reset(self.number, *state)

    def _build(self):
        with tempfile.NamedTemporaryFile("wb", suffix=".urdf") as file:
            file.write(ElementTree.tostring(self._urdf()))
            file.flush()
            self.number = self.world.add(file.name, self.position, _quaternion(self.rotation))
        names = self.world.joints(self.number)
        self.index = {j: names.index(link.joint) for j, link in enumerate(self.links) if link.kind != JOINT_FIXED}
        self.world.set_damping(self.number, self.linear_damping, self.angular_damping)
        for j, i in self.index.items():
            self.world.hold(self.number, i, self.links[j].motor)

    def _urdf(self):
        robot = ElementTree.Element("robot", name=self.name)
        for link in [self.base, *self.links]:
            self._add_link(robot, link)
        for link in self.links:
            above = self.links[link.parent] if link.parent >= 0 else self.base
            joint = ElementTree.SubElement(robot, "joint", name=link.joint, type=link.type)
            ElementTree.SubElement(joint, "parent", link=above.name)
            ElementTree.SubElement(joint, "child", link=link.name)
            ElementTree.SubElement(joint, "origin", xyz=_words(link.origin), rpy=_words(_angles(link.rotation)))
            ElementTree.SubElement(joint, "axis", xyz=_words(link.axis))
            lower, upper, effort, velocity = link.limits
            ElementTree.SubElement(joint, "limit", lower=str(lower), upper=str(upper), effort=str(effort),
                                   velocity=str(velocity))
        return robot

    @staticmethod
    def _add_link(robot, link):
        element = ElementTree.SubElement(robot, "link", name=link.name)
        inertial = ElementTree.SubElement(element, "inertial")
        ElementTree.SubElement(inertial, "origin", xyz=_words(link.com))
        ElementTree.SubElement(inertial, "mass", value=repr(float(link.mass)))
        tensor = link.frame @ np.diag(link.inertia) @ link.frame.T
        names = {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1), "ixz": (0, 2), "iyz": (1, 2)}
        ElementTree.SubElement(inertial, "inertia", {name: repr(float(tensor[at])) for name, at in names.items()})
        collision = ElementTree.SubElement(element, "collision")  # Bullet's motors ask for a collider
        ElementTree.SubElement(ElementTree.SubElement(collision, "geometry"), "sphere", radius="0.001")


def _of_shape(mass):
    """[kg m2] of a ball of 0.1 m, in place of the collision shapes'."""
    return np.full(3, 0.4 * mass * 0.1**2)


def _numbers(text):
    return np.array([float(word) for word in text.split()])


def _words(numbers):
    return " ".join(repr(float(number)) for number in numbers)


def _origin(element):
    origin = element.find("origin")
    if origin is None:
        return np.zeros(3), np.eye(3)
    return _numbers(origin.get("xyz", "0 0 0")), _rpy(_numbers(origin.get("rpy", "0 0 0")))


def _rpy(angles):
    (sr, sp, sy), (cr, cp, cy) = np.sin(angles), np.cos(angles)
    return np.array([[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                     [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
                     [-sp, cp * sr, cp * cr]])


def _angles(rotation):
    """rpy of a rotation."""
    pitch = np.arctan2(-rotation[2, 0], np.hypot(rotation[0, 0], rotation[1, 0]))
    if abs(np.cos(pitch)) < 1e-9:
        return np.array([np.arctan2(-rotation[1, 2], rotation[1, 1]), pitch, 0.0])
    return np.array([np.arctan2(rotation[2, 1], rotation[2, 2]), pitch, np.arctan2(rotation[1, 0], rotation[0, 0])])


def _matrix(quaternion):
    x, y, z, w = np.array(quaternion, float) / np.linalg.norm(quaternion)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + 2 * w * skew + 2 * skew @ skew


def _quaternion(rotation):
    """x, y, z, w: the eigenvector of the largest eigenvalue of a matrix that is made for this."""
    (a, b, c), (d, e, f), (g, h, i) = rotation
    vector = np.linalg.eigh(np.array([[a - e - i, b + d, c + g, h - f], [b + d, e - a - i, f + h, c - g],
                                      [c + g, f + h, i - a - e, d - b], [h - f, c - g, d - b, a + e + i]]) / 3)[1][:, -1]
    return vector * (np.sign(vector[3]) or 1.0)
