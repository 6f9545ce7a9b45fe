"""What a wish costs, and when it is too late for it: a point that is 0.1 rad off the way, wished ever shorter before.

    python3 06_wishes.py            # writes wishes.png; needs python3-matplotlib
"""

import matplotlib
import numpy as np

matplotlib.use("Agg")  # leave this out to see it in a window: matplotlib.pyplot.show()
import matplotlib.pyplot as plt

import seam

t = np.linspace(0.0, 1.0, 501)
rise = t**3 * (10.0 - 15.0 * t + 6.0 * t**2)  # minimum jerk, 1 rad in 1 s
reach = seam.learn(seam.Demonstration(t, {"E1": rise}), kernels=20)
MOMENT = 0.6  # [s] when it is to pass
dt = 1e-3


def play(ahead, join="dmp2a"):
    """The motion until 1 s when the point is wished a time before it; None where it is refused. And the price."""
    task = seam.Sequence().then(reach).arrive()
    player = seam.Sequencer(task, join)
    point = [rise[t.searchsorted(MOMENT)] + 0.1]
    way, price = [], None
    for k in range(1001):
        if k == round((MOMENT - ahead) / dt):
            wish = seam.pass_(point, seam.at(MOMENT))
            price = player.price_of(player.wishes, wish)
            if not player.set_wish(player.wishes, wish):
                return None, price
        way.append(player.sample.position[0])
        player.step(dt)
    return np.array(way), price


aheads = [0.5, 0.3, 0.2, 0.15, 0.12, 0.1, 0.08, 0.06, 0.05, 0.04, 0.03, 0.02]
print("wished ahead [s]   " + "   ".join(f"{join.name}: deviation [rad], acceleration [rad/s²]" for join in seam.all_joins))
prices = {join.name: [play(ahead, join)[1] for ahead in aheads] for join in seam.all_joins}
for i, ahead in enumerate(aheads):
    row = [prices[name][i] for name in prices]
    print(f"{ahead:16.2f}   " + "   ".join(
        f"{p.deviation[0]:.3f}, {p.acceleration[0]:.0f}" if p.possible else "refused" for p in row))

figure, (motion, cost, peak) = plt.subplots(1, 3, figsize=(11, 3.4), constrained_layout=True)
time = np.arange(1001) * dt
motion.plot(t, rise, color="0.7", label="as shown")
for ahead in (0.5, 0.3, 0.1, 0.06):
    motion.plot(time, play(ahead)[0], label=f"{ahead:g} s ahead")
motion.plot(MOMENT, rise[t.searchsorted(MOMENT)] + 0.1, "ko", markersize=4)
motion.set(xlabel="time [s]", ylabel="E1 [rad]", title="dmp2a: the point is wished …")
motion.legend(fontsize=8)
for name, row in prices.items():
    met = [(ahead, p) for ahead, p in zip(aheads, row) if p.possible]
    cost.plot([ahead for ahead, _ in met], [p.deviation[0] for _, p in met], "o-", markersize=3, label=name)
    peak.plot([ahead for ahead, _ in met], [p.acceleration[0] for _, p in met], "o-", markersize=3, label=name)
cost.set(xlabel="wished ahead [s]", xscale="log", yscale="log", title="deviation [rad]")
peak.set(xlabel="wished ahead [s]", xscale="log", yscale="log", title="greatest acceleration [rad/s²]")
cost.legend(fontsize=8)
for axes in (cost, peak):
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("")
    axes.set_xticks([0.05, 0.1, 0.2, 0.5])
cost.set_yticks([0.1, 0.2, 0.5, 1.0])
peak.set_yticks([10, 20, 50, 100, 200])
figure.savefig("wishes.png", dpi=110)
