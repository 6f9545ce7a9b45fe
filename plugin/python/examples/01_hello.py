"""Two movements of an arm, joined while the first still moves: the state comes in, torque goes out.

    python3 01_hello.py
"""

import numpy as np

import seam

reach = seam.learn(seam.Demonstration.read(seam.asset("demos/ramp_up.csv")))
back = seam.learn(seam.Demonstration.read(seam.asset("demos/ramp_down.csv")))
task = seam.Sequence().then(reach, until=seam.before_end(0.4)).then(back)  # hand over 0.4 s before reach ends

arm = seam.RobotModel.read(seam.asset("pa10/pa10.urdf"))
q, qd = np.zeros(arm.dof), np.zeros(arm.dof)
control = seam.ArmController(arm, task, join="dmp3", q=q)

# An arm that does exactly what it is told. Put yours here: read its state, send it the torque.
dt, torques = 1e-3, []
while not control.finished:
    torques.append(control.tick(dt, q, qd))  # [N·m]
    q, qd = control.last_tick.reference.position, control.last_tick.reference.velocity

step = seam.jump(dt * np.arange(len(torques)), torques, at=control.sequencer.join(1).time)  # a value for each joint
print(f"torques up to {np.abs(torques).max():.0f} N·m; at the join they step by {np.abs(step).max():.2f} N·m")
