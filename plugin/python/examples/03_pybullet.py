"""An arm in PyBullet follows a sequence to round-off.

    python3 03_pybullet.py            # pip install pybullet
"""

import numpy as np
import pybullet as p

import seam
import seam.pybullet

p.connect(p.DIRECT)  # p.GUI to look at it
p.setGravity(0, 0, -9.81)
p.setTimeStep(1e-3)
urdf = seam.asset("pa10/pa10.urdf")
body = p.loadURDF(urdf, useFixedBase=True, flags=p.URDF_USE_INERTIA_FROM_FILE)

reach = seam.learn(seam.Demonstration.read(seam.asset("demos/ramp_up.csv")))
back = seam.learn(seam.Demonstration.read(seam.asset("demos/ramp_down.csv")))
task = seam.Sequence().then(reach, until=seam.before_end(0.4)).then(back)

control = seam.pybullet.attach(body, task, join="dmp3", urdf=urdf)
print("\n".join(control.changed))
worst = 0.0
while not control.finished:
    control.step()
    tick = control.arm.last_tick
    worst = max(worst, np.abs(tick.q - tick.reference.position).max())
print(f"never further than {worst:.0e} rad from the reference")
p.disconnect()
