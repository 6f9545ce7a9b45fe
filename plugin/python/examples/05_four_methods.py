"""The four methods on one scene: what each makes of the torque at the join, as a table and as a picture.

    python3 05_four_methods.py            # writes four_methods.png; needs python3-matplotlib
"""

import matplotlib

matplotlib.use("Agg")  # leave this out to see it in a window: matplotlib.pyplot.show()

import seam

runs = {method.name: seam.play("line", method=method) for method in seam.all_joins}

print("method   torque jump [N·m]   deviation from dmp2 [rad]")
for method, run in runs.items():
    metrics = seam.measure(run, dmp2=runs["dmp2"])
    print(f"{method:6} {metrics.torque_jump_nm:19.3f} {metrics.deviation_peak_rad:27.4f}")

figure = seam.plot(runs, join=1, within=0.35)  # join 0 is the start
figure.savefig("four_methods.png", dpi=120)
