"""seam joins movement primitives on an arm without a step in torque.

    import seam

    reach = seam.learn(seam.Demonstration.read("reach.csv"))
    back = seam.learn(seam.Demonstration.read("back.csv"))
    task = seam.Sequence().then(reach, until=seam.before_end(0.4)).then(back)
    path = seam.rollout(task, "dmp3")                  # the movement alone
    arm = seam.RobotModel.read("arm.urdf")
    control = seam.ArmController(arm, task, join="dmp3", q=q0)
    torque = control.tick(dt, q, qd)                   # in a loop: state in, torque out

Names, units and defaults are those of the C++ library. SI units throughout; joint values are [rad], or [m] where a joint
slides. Whatever numpy makes an array of is taken for an array. What seam refuses is a `seam.Error`, which is a ValueError.
"""

import os as _os

from . import _seam
from ._columns import Columns as Columns
from ._recordings import plot as plot
from ._scenes import asset as asset, play as play, scenes as scenes
from ._seam import *  # noqa: F403
from ._seam import __version__ as __version__

# Scenes and assets lie in a wheel's own share, or in that of the program which is installed with the module.
_here = _os.path.dirname(_os.path.abspath(__file__))
for _share in (_os.path.join(_here, "share"), _os.path.normpath(_os.path.join(_here, "../../../../share/seam"))):
    if _os.path.isdir(_os.path.join(_share, "scenes")):
        _seam._set_own_folder(_share)
        break

Columns.__module__ = "seam"

__all__ = sorted({name for name in dir(_seam) if not name.startswith("_")} | {"Columns", "asset", "play", "plot", "scenes"})
