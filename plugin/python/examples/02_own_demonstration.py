"""From numpy arrays to a primitive, a file, and a movement that goes elsewhere and faster.

    python3 02_own_demonstration.py       # writes hand.yaml
"""

import numpy as np

import seam

time = np.linspace(0.0, 1.5, 151)  # [s]; times need not be even
hand = {"x": 0.3 * np.sin(time) ** 2, "y": 0.1 * time, "z": 0.4 + 0.05 * np.cos(4 * time)}  # [m]
demo = seam.Demonstration(time, hand)  # a frame of pandas, or a CSV file: seam.Demonstration.read("hand.csv")

primitive = seam.learn(demo, precision=1e-3)  # as few kernels as it takes to be within 1 mm
report = seam.assess(demo, primitive)
print(f"{primitive.kernels.count} kernels reproduce it within {1e3 * report.error_max:.2f} mm")
primitive.write("hand.yaml")

other = seam.Primitive.read("hand.yaml").at_speed(1.5)
other.goal = other.goal + [0.1, 0.0, 0.0]  # 10 cm further
path = seam.rollout(seam.Sequence().then(other), dt=1e-3)
print(f"after {path.time[-1]:.1f} s it is at x = {path.tool_ref['x'][-1]:.3f} m; the hand ended at {hand['x'][-1]:.3f} m")
