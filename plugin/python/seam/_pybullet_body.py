"""What PyBullet simulates of a body, held against a model of it."""

import math

import numpy as np

import seam

# PyBullet's numbers, as in its quick-start guide.
REVOLUTE, PRISMATIC, FIXED = 0, 1, 4

_AGREEMENT = 1e-6  # of mass, centre of mass and inertia, relative


class Link:
    """A link and the joint that moves it. Frames are at centres of mass, along principal axes, but for the URDF's."""

    def __init__(self, client, j):
        joint = client.call("getJointInfo", client.body, j)
        dynamics = client.call("getDynamicsInfo", client.body, j)
        self.joint, self.link = text(joint[1]), text(joint[12])
        self.kind, self.parent, self.damping = joint[2], joint[16], joint[6]
        self.axis = np.array(joint[13])
        self.pivot_in_parent = np.array(joint[14])
        self.rotation_in_parent = rotation_matrix(joint[15]).T
        self.mass = dynamics[0]
        self.inertia = np.array(dynamics[2])
        self.rotation_in_urdf = rotation_matrix(dynamics[4])  # of the centre-of-mass frame in the URDF's link frame
        self.com_in_urdf = np.array(dynamics[3])
        self.com_from_pivot = self.rotation_in_urdf.T @ self.com_in_urdf

    def place(self, parent, q):
        """Puts the link at joint position q: `rotation` (3 x 3) and `com` [m] in the base, likewise `pivot` and
        `direction` of its joint."""
        above, origin = (parent.rotation, parent.com) if parent else (np.eye(3), np.zeros(3))
        self.rotation = above @ self.rotation_in_parent
        self.direction = self.rotation @ self.axis
        self.pivot = origin + above @ self.pivot_in_parent
        if self.kind == REVOLUTE:
            self.rotation = self.rotation @ _turn(self.axis, q)
        self.com = self.pivot + self.rotation @ self.com_from_pivot
        if self.kind == PRISMATIC:
            self.com = self.com + q * self.direction


def rotation_matrix(quaternion):
    """3 x 3, of x, y, z, w."""
    x, y, z, w = np.array(quaternion) / np.linalg.norm(quaternion)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def _turn(axis, angle):
    half = 0.5 * angle
    return rotation_matrix([*(math.sin(half) * axis), math.cos(half)])


def text(name):
    return name.decode(errors="replace") if isinstance(name, bytes) else name


def listed(names):
    return ", ".join(f'"{name}"' for name in names)


def joints_by_name(client, model, links):
    """PyBullet's index of each of the model's joints."""
    with client.errors():
        who = client.name()
    index = {link.joint: j for j, link in enumerate(links)}
    joints = []
    for joint in model.joints:
        if joint.name not in index:
            raise seam.Error(f'{who}: no joint "{joint.name}" of the model among {listed(index)}')
        kind = PRISMATIC if joint.type == seam.Joint.Type.prismatic else REVOLUTE
        if links[index[joint.name]].kind != kind:
            raise seam.Error(f'{who}: joint "{joint.name}" is of another type than the model\'s')
        joints.append(index[joint.name])
    for j, link in enumerate(links):
        if link.parent >= j:
            raise seam.Error(f'{who}: link "{link.link}" comes before its parent, which PyBullet simulates wrongly: load it without '
                             f"URDF_MAINTAIN_LINK_ORDER")
    for j in joints:
        length = np.linalg.norm(links[j].axis)
        if abs(length - 1) > 1e-7:
            raise seam.Error(f'{who}: the axis of joint "{links[j].joint}" has length {length:.9g}, which PyBullet takes as it is: '
                             f"make it 1 in the URDF")
    return joints


def _place(links, joints, q):
    at = dict(zip(joints, q))
    for j, link in enumerate(links):
        link.place(links[link.parent] if link.parent >= 0 else None, at.get(j, 0.0))


def _ancestors(links, j):
    while j >= 0:
        yield j
        j = links[j].parent


def _mass_matrix(links, joints, q):
    """Of what PyBullet simulates, in the order of `joints`: n x n [kg m2, kg m or kg].

    calculateMassMatrix does not serve: what it has found of a body once it keeps, also after a mass was changed."""
    _place(links, joints, q)
    column = {j: i for i, j in enumerate(joints)}
    matrix = np.zeros((len(joints), len(joints)))
    for b, link in enumerate(links):
        linear, angular = np.zeros((3, len(joints))), np.zeros((3, len(joints)))
        for j in _ancestors(links, b):
            if j in column:
                by = links[j]
                turns = by.kind == REVOLUTE
                linear[:, column[j]] = np.cross(by.direction, link.com - by.pivot) if turns else by.direction
                angular[:, column[j]] = by.direction if turns else 0.0
        along = link.rotation.T @ angular
        matrix += link.mass * linear.T @ linear + along.T @ (link.inertia[:, None] * along)
    return matrix


def bodies_of(links, joints, q):
    """Mass [kg], centre of mass [m] and inertia about it [kg m2] of what each joint moves rigidly, in the frame of the URDF
    link behind the joint."""
    _place(links, joints, q)
    mine = {j: [] for j in joints}
    for b in range(len(links)):
        joint = next((j for j in _ancestors(links, b) if j in mine), None)
        if joint is not None:
            mine[joint].append(links[b])
    bodies = []
    for j in joints:
        root = links[j].rotation @ links[j].rotation_in_urdf.T
        origin = links[j].com - root @ links[j].com_in_urdf
        mass = sum(link.mass for link in mine[j])
        com = sum((link.mass * link.com for link in mine[j]), np.zeros(3)) / mass if mass else links[j].com
        inertia = np.zeros((3, 3))
        for link in mine[j]:
            arm = link.com - com
            inertia += link.rotation @ np.diag(link.inertia) @ link.rotation.T
            inertia += link.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        bodies.append((mass, root.T @ (com - origin), root.T @ inertia @ root, mine[j]))
    return bodies


def require_agreement(client, model, links, joints):
    dynamics = seam.InverseDynamics(model)
    neutral = np.array(model.neutral())
    still = np.zeros(model.dof)
    for q in (neutral, neutral + 0.3 + 0.4 * np.arange(model.dof) % 1.7):
        theirs = _mass_matrix(links, joints, q)
        ours = np.array([dynamics.torque(q, still, unit) for unit in np.eye(model.dof)]) - dynamics.torque(q, still, still)
        size = np.sqrt(np.abs(np.diag(ours)))
        if not np.all(np.abs(theirs - ours) <= _AGREEMENT * np.outer(size, size)):
            with client.errors():
                raise seam.Error(f"{client.name()}: {_what_differs(model, bodies_of(links, joints, neutral))}")


def differs(inertial, mass, com, inertia):
    moment = np.array(inertial.inertia)
    return (abs(mass - inertial.mass) > _AGREEMENT * inertial.mass or
            np.linalg.norm(com - inertial.com) > _AGREEMENT * (np.linalg.norm(com) + 1e-3) or
            np.abs(inertia - moment).max() > _AGREEMENT * np.abs(moment).max())


def _what_differs(model, theirs):
    """One line on what PyBullet simulates otherwise than the model says."""
    differ = [(body, *of) for body, of in zip(model.bodies, theirs) if differs(body.inertial, *of[:3])]
    masses = [of for of in differ if abs(of[1] - of[0].inertial.mass) > _AGREEMENT * of[0].inertial.mass]
    scales = [np.linalg.norm(of[1]) / np.linalg.norm(body.inertial.com) for body, of in zip(model.bodies, theirs)
              if np.linalg.norm(body.inertial.com) > 1e-3]
    if masses:
        return _of_mass(*masses[0], len(masses))
    if scales and abs(scales[0] - 1) > 1e-3 and np.ptp(scales) < 1e-3 * scales[0]:
        return f"is scaled by {scales[0]:.4g}, which the model is not: load it with globalScaling=1"
    if differ:
        return _of_inertia(*differ[0], len(differ), len(theirs))
    return "its joints are elsewhere than the model's, or have other axes: was another URDF loaded, or a scale given?"


def _of_mass(body, mass, com, inertia, links, count):
    more = f", and those of {count - 1} more" if count > 1 else ""
    made_up = [link.link for link in links if link.mass == 1.0 and not link.com_in_urdf.any()]
    if made_up and abs(mass - body.inertial.mass - len(made_up)) < 1e-6:
        return (f"link {listed(made_up)} weighs 1 kg in PyBullet, as any link without <inertial>, and nothing in the model: give it "
                f'an <inertial> of mass 0, or pass inertia="pybullet"')
    carried = [link.link for link in links if link.link != body.link]
    with_them = f", with {listed(carried)} fixed to it," if carried else ""
    return (f'the mass of link "{body.link}"{with_them} is {mass:.9g} kg, in the model {body.inertial.mass:.9g} kg{more}: was it '
            f'changed by changeDynamics? inertia="pybullet" takes it over')


def _of_inertia(body, mass, com, inertia, links, count, of):
    empty = [link.link for link in links if link.mass == 0 and link.inertia.any()]
    if empty:
        return (f"link {listed(empty)} has inertia and no mass, which the model leaves out: give it an inertia of 0, or pass "
                f'inertia="pybullet"')
    return (f'the inertia of link "{body.link}" has moments {_moments(inertia)} kg m2, in the model {_moments(body.inertial.inertia)} '
            f"({count} of {of} links differ): load it with flags=URDF_USE_INERTIA_FROM_FILE (without it PyBullet takes the inertia of "
            f'the collision shapes, and moments that no solid can have for 0), or pass inertia="pybullet"')


def _moments(inertia):
    return "(" + ", ".join(f"{moment:.4g}" for moment in np.linalg.eigvalsh(inertia)) + ")"
