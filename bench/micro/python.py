"""What seam costs from Python, each beside the same in C++, numpy or PyBullet.

    PYTHONPATH=build/release/python:build/release/bench /usr/bin/python3 bench/micro/python.py [--append FILE] [--strict]

Both of a pair are measured in turn, A B A B ..., in this thread's time on the processor. `make micro` runs it.
"""

import os

os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")  # the clock is that of one thread

import argparse
import pathlib
import platform
import statistics
import sys
import tempfile
import time

import numpy as np

import seam
import seam_micro_python

URDF = str(pathlib.Path(__file__).parents[2] / "assets" / "pa10" / "pa10.urdf")
DT = 1e-3  # [s]
HEAD = ("what / beside what", "time", "fastest", "beside", "fastest", "ratio", "bar", "")


class Pair:
    """Two pieces of work, measured in turn. Each is called with no argument, and gives its time [s] per item."""

    def __init__(self, work, beside, pairs):
        work(), beside()  # warms up
        self.work, self.beside = [], []
        for _ in range(pairs):
            self.work.append(work())
            self.beside.append(beside())

    def row(self, name, bar=None):
        """Medians, minima, the median of the ratios; `bar` [s] is for the work's time."""
        ratio = statistics.median(a / b for a, b in zip(self.work, self.beside))
        times = [shown(f(part)) for part in (self.work, self.beside) for f in (statistics.median, min)]
        return (name, *times, shown_ratio(ratio), *judged(statistics.median(self.work), bar))

    def more(self, name, bar):
        """What the work takes more than what is beside it."""
        median = statistics.median(a - b for a, b in zip(self.work, self.beside))
        return (name, shown(median), shown(min(self.work) - min(self.beside)), "", "", "", *judged(median, bar))


def shown(seconds):
    if seconds < 1e-6:
        return f"{seconds * 1e9:.0f} ns"
    return f"{seconds * 1e6:.3g} µs" if seconds < 1e-3 else f"{seconds * 1e3:.3g} ms"


def shown_ratio(ratio):
    return f"{ratio:.2f}" if ratio >= 0.1 else f"{ratio:.2g}"


def judged(seconds, bar):
    return ("", "") if bar is None else (shown(bar), "met" if seconds <= bar else "missed")


def timed(work, times=1):
    """Does it so often in a row."""

    def measured():
        begin = time.thread_time()
        for _ in range(times):
            work()
        return (time.thread_time() - begin) / times

    return measured


def markdown(rows):
    widths = [max(len(row[i]) for row in rows) for i in range(len(HEAD))]
    lines = []
    for row in rows:
        cells = [cell.ljust(width) if i == 0 else cell.rjust(width) for i, (cell, width) in enumerate(zip(row, widths))]
        lines.append("| " + " | ".join(cells) + " |\n")
    rule = [("-" * (width + 2) if i == 0 else "-" * (width + 1) + ":") for i, width in enumerate(widths)]
    return "".join([lines[0], "|" + "|".join(rule) + "|\n", *lines[1:]])


# The movement: two joined reaches of the PA-10's seven joints.

Q0 = np.array([0.1, 0.4, -0.1, 1.2, 0.2, 0.8, 0.0])
BY = np.linspace(0.4, -0.2, 7)


def reach(names, begin, by):
    t = np.linspace(0.0, 1.0, 501)
    return seam.learn(seam.Demonstration(t, begin + np.outer(0.5 - 0.5 * np.cos(np.pi * t), by), names))


class Movement:
    before_end = 0.3  # [s]

    def __init__(self):
        self.model = seam.RobotModel.read(URDF)
        names = [joint.name for joint in self.model.joints]
        self.there, self.back = reach(names, Q0, BY), reach(names, Q0 + BY, -BY)
        self.task = seam.Sequence().then(self.there, until=seam.before_end(self.before_end)).then(self.back)
        path = seam.rollout(self.task, "dmp3", duration=1.7, dt=DT)
        # The reference fed back as the state: the arm follows it.
        self.q, self.qd = [row.copy() for row in path.ref], [row.copy() for row in path.ref_vel]

    def controller(self):
        return seam.ArmController(self.model, self.task, "dmp3", q=self.q[0], qd=self.qd[0])

    def ticks(self):
        """Plays it in Python; the time of a tick, and the last one's torque."""
        control = self.controller()
        states = list(zip(self.q, self.qd))
        begin = time.thread_time()
        for q, qd in states:
            torque = control.tick(DT, q, qd)
        took = time.thread_time() - begin
        assert control.status == seam.ArmController.Status.following
        return took / len(states), torque

    def ticks_in_cpp(self):
        """Gives a function that plays it in C++, likewise."""
        with tempfile.NamedTemporaryFile(suffix=".yaml") as file:
            seam.write_sequence(file.name, seam.SequenceFile(self.task, ["there", "back"]))
            ticks = seam_micro_python.Ticks(URDF, file.name, self.q, self.qd)

        def play():
            took, torque = ticks.play(DT)
            return took / len(self.q), torque

        return play


def tick_rows(movement):
    in_cpp = movement.ticks_in_cpp()
    np.testing.assert_array_equal(movement.ticks()[1], in_cpp()[1])  # it is the same
    pair = Pair(lambda: movement.ticks()[0], lambda: in_cpp()[0], 400)
    return [pair.row("`ArmController.tick` from Python / the same loop in C++"),
            pair.more("of it, what Python adds", 2e-6)]


# PyBullet, where it is there.


class Bullet:
    """The arm in a PyBullet of its own, and its calls in a tick."""

    def __init__(self, pybullet, movement):
        import seam.pybullet
        from pybullet_utils.bullet_client import BulletClient

        self.api = BulletClient(connection_mode=pybullet.DIRECT)
        self.api.setGravity(0, 0, -9.81)
        self.api.setTimeStep(DT)
        self.body = self.api.loadURDF(URDF, useFixedBase=True, flags=pybullet.URDF_USE_INERTIA_FROM_FILE)
        self.mode = pybullet.TORQUE_CONTROL
        self.joints = [j for j in range(self.api.getNumJoints(self.body))
                       if self.api.getJointInfo(self.body, j)[2] == pybullet.JOINT_REVOLUTE]
        self.movement = movement
        self.take_over = seam.pybullet.attach
        control = self.attach()
        self.torques = []
        for _ in movement.q:
            control.step()
            self.torques.append(control.torque.tolist())
        self.own()
        q = [state[0] for state in self.api.getJointStates(self.body, self.joints)]
        np.testing.assert_allclose(q, movement.q[-1], atol=1e-3)  # it is the same movement

    def attach(self):
        for joint, q, qd in zip(self.joints, self.movement.q[0], self.movement.qd[0]):
            self.api.resetJointState(self.body, joint, q, qd)
        return self.take_over(self.body, self.movement.task, "dmp3", client=self.api, urdf=URDF)

    def seams(self):
        """seam.pybullet's tick and the step."""
        control = self.attach()
        took = timed(control.step, len(self.torques))()
        assert control.status == seam.ArmController.Status.following
        return took

    def own(self):
        """PyBullet's own calls alone, the arm driven by the torques of before."""
        self.attach()
        api, body, joints, mode = self.api, self.body, self.joints, self.mode
        begin = time.thread_time()
        for torque in self.torques:
            api.getJointStates(body, joints)
            api.setJointMotorControlArray(body, joints, mode, forces=torque)
            api.stepSimulation()
        return (time.thread_time() - begin) / len(self.torques)


def pybullet_rows(movement):
    names = ["`ArmController.tick` from Python / PyBullet's own calls in a tick",
             "`seam.pybullet`'s tick and PyBullet's step / PyBullet's own calls in a tick"]
    try:
        import pybullet
    except ImportError:
        return [(name, "not there", *[""] * 6) for name in names]
    bullet = Bullet(pybullet, movement)
    return [Pair(lambda: movement.ticks()[0], bullet.own, 50).row(names[0]),
            Pair(bullet.seams, bullet.own, 50).row(names[1])]


# Learning.

T = np.linspace(0.0, 1.0, 1000)
SHOWN = np.sin(2.0 * np.pi * T[:, None] + np.arange(7))


def learn_by_numpy(time, position, velocity, acceleration, like):
    """Least squares over all kernels at once (Eqs. 13, 15), with the kernels, gains and alpha of `like`."""
    tau, goal = time[-1] - time[0], position[-1]
    target = tau**2 * acceleration + tau * like.gains.D * velocity + like.gains.K * (position - goal)
    x = np.exp(-like.alpha * (time - time[0]) / tau)
    psi = np.exp(-((x[:, None] - like.kernels.centers) ** 2) / (2.0 * like.kernels.widths**2))
    A = x[:, None] * psi / psi.sum(axis=1, keepdims=True)
    return np.linalg.lstsq(A, target, rcond=None)[0]


def derivatives_by_numpy(time, position):
    velocity = np.gradient(position, time, axis=0)
    return velocity, np.gradient(velocity, time, axis=0)


def learn_rows():
    demo = seam.Demonstration(T, SHOWN)
    learned = seam.learn(demo)
    of_demo = demo.time, demo.position, demo.velocity, demo.acceleration
    np.testing.assert_allclose(learn_by_numpy(*of_demo, learned), learned.weights, atol=1e-6 * np.abs(learned.weights).max())
    return [
        Pair(timed(lambda: seam.learn(demo)), timed(lambda: learn_by_numpy(*of_demo, learned)), 500)
        .row("`seam.learn`, 1000 samples × 7 / `numpy.linalg.lstsq` on the same equations"),
        Pair(timed(lambda: seam.learn(seam.Demonstration(T, SHOWN))),
             timed(lambda: learn_by_numpy(T, SHOWN, *derivatives_by_numpy(T, SHOWN), learned)), 500)
        .row("the same from positions alone, by a smoothing fit / by `numpy.gradient`, which smooths nothing"),
    ]


# Rollout.


def rollout_by_numpy(first, second, before_end, steps):
    """Two primitives joined by dmp3 (Eqs. 1 to 6), by Euler's method: arrays over the joints, a loop over the ticks."""
    y, yd, ydd = first.start_position, np.zeros(first.dimensions), np.zeros(first.dimensions)  # from rest
    path = np.empty((3, steps + 1, len(y)))
    join = round((first.tau - before_end) / DT)
    for begin, end, p in ((0, join, first), (join, steps + 1, second)):
        K, D, H, tau = p.gains.K, p.gains.D, p.gains.H, p.tau
        weights, goal, centers, precision = p.weights, p.goal, p.kernels.centers, 0.5 / p.kernels.widths**2
        psi = np.exp(-precision * (1.0 - centers) ** 2)
        v, x = tau * yd, 1.0
        r = y + (tau**2 * ydd + D * v - psi @ weights / psi.sum()) / K  # Eq. 6
        for k in range(begin, end):
            psi = np.exp(-precision * (x - centers) ** 2)
            vd = (K * (r - y) - D * v + x * (psi @ weights) / psi.sum()) / tau
            yd, ydd = v / tau, vd / tau
            path[0, k], path[1, k], path[2, k] = y, yd, ydd
            y = y + DT * yd
            v = v + DT * vd
            r = r + DT * H / tau * (goal - r)
            x -= DT * p.alpha / tau * x
    return path


def rollout_rows(movement):
    def by_seam():
        return seam.rollout(movement.task, "dmp3", dt=DT, duration=1.0)

    def by_numpy():
        return rollout_by_numpy(movement.there, movement.back, movement.before_end, 1000)

    path = by_seam()
    np.testing.assert_allclose(by_numpy(), (path.ref, path.ref_vel, path.ref_acc), atol=0.1)  # Euler's error is in it
    return [Pair(timed(by_seam, 5), timed(by_numpy), 100)
            .row("`seam.rollout`, 7 joints, 1 s at 1 ms / a loop of numpy, by Euler's method", 1e-3)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--append", metavar="FILE", help="file to whose end the table goes (Markdown)")
    parser.add_argument("--strict", action="store_true", help="exit code 1 if a bar is missed")
    options = parser.parse_args()
    movement = Movement()
    rows = [HEAD, *tick_rows(movement), *pybullet_rows(movement), *learn_rows(), *rollout_rows(movement)]
    report = f"\n{markdown(rows)}\nMeasured by Python {platform.python_version()} with numpy {np.__version__}.\n"
    print(report, end="")
    if options.append:
        with open(options.append, "a", encoding="utf-8") as file:
            file.write(report)
    return 1 if options.strict and any(row[-1] == "missed" for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
