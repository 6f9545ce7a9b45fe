"""What the tests share: an arm, and movements for it."""

import os
import pathlib

import numpy as np
import pytest

import seam

SOURCE = pathlib.Path(os.environ.get("SEAM_SOURCE", pathlib.Path(__file__).parents[2]))
PA10 = str(SOURCE / "assets" / "pa10" / "pa10.urdf")


def rise(t):
    """Minimum jerk from 0 to 1 in 1 s."""
    return 10 * t**3 - 15 * t**4 + 6 * t**5


def movement(begin, end, samples=401):
    """A demonstration [rad] between two postures, by joint name, in 1 s."""
    t = np.linspace(0.0, 1.0, samples)
    return seam.Demonstration(t, {name: begin[name] + (end[name] - begin[name]) * rise(t) for name in begin})


@pytest.fixture(scope="session")
def arm():
    return seam.RobotModel.read(PA10)


@pytest.fixture
def q0(arm):
    return np.array([0.0, 0.5, 0.0, 1.0, 0.0, 0.5, 0.0])


@pytest.fixture
def task(arm, q0):
    """There, and back before the first has come to rest."""
    names = [joint.name for joint in arm.joints]
    here = dict(zip(names, q0))
    there = dict(zip(names, q0 + [0.4, -0.3, 0.5, 0.4, -0.5, 0.3, 0.6]))
    out = seam.learn(movement(here, there))
    back = seam.learn(movement(there, here))
    return seam.Sequence().then(out, until=seam.before_end(0.4)).then(back)
