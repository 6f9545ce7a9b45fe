"""A camera sees the target better the nearer the arm comes, and the goal follows what it sees, without a step in torque.

    python3 04_goal_from_a_sensor.py
"""

import numpy as np

import seam

time = np.linspace(0.0, 2.0, 201)
rise = 10 * (time / 2) ** 3 - 15 * (time / 2) ** 4 + 6 * (time / 2) ** 5
expected, target = np.array([0.5, 1.0]), np.array([0.6, 1.2])  # [rad]
reach = seam.learn(seam.Demonstration(time, np.outer(rise, expected), coordinates=["S1", "E1"]))

sequencer = seam.Sequencer(seam.Sequence().then(reach), join="dmp2a")
random = np.random.default_rng(1)
largest_step = 0.0
for tick in range(4000):
    if tick % 33 == 0 and tick < 1800:  # thirty pictures a second, until shortly before the end
        distance = np.linalg.norm(target - sequencer.sample.position)
        before = sequencer.sample.acceleration
        sequencer.set_goal(target + 0.02 * distance * random.standard_normal(2))
        largest_step = max(largest_step, np.abs(sequencer.sample.acceleration - before).max())
    sequencer.step(1e-3)

error = np.linalg.norm(sequencer.sample.position - target)
print(f"{error:.4f} rad from the target; the acceleration never stepped by more than {largest_step:.0e} rad/s²")
