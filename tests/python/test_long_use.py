"""Memory stays flat over millions of ticks and thousands of controllers."""

import gc
import pathlib

import numpy as np

import seam


def resident():
    """[bytes] of this process in memory."""
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return 4096 * pages


def grown(work, times):
    """[bytes] by which memory grows while something is done again and again, after a tenth of it to warm up."""
    work(times // 10)
    gc.collect()
    before = resident()
    work(times)
    gc.collect()
    return resident() - before


def test_a_million_ticks(arm, task, q0):
    control = seam.ArmController(arm, task, q=q0)
    q, qd = q0.copy(), np.zeros(7)

    def tick(times):
        for _ in range(times):
            control.tick(1e-3, q, qd)

    assert grown(tick, 1_000_000) < 2**20


def test_ten_thousand_controllers(arm, task, q0):
    def make(times):
        for _ in range(times):
            seam.ArmController(arm, task, q=q0).tick(1e-3, q0, np.zeros(7))

    assert grown(make, 10_000) < 2**20


def test_recordings_errors_and_settings(task):
    def use(times):
        for _ in range(times):
            path = seam.rollout(task, "dmp3", dt=1e-2)
            path.ref["E1"].sum(), path.to_pandas, path.joins
            seam.ArmControllerSettings(law=seam.ControlSettings(Kp=[1.0] * 7))
            try:
                seam.rollout(task, "no such join")
            except seam.Error:
                pass

    assert grown(use, 5_000) < 2**20


def test_a_leak_would_be_found():
    kept = []
    assert grown(lambda times: kept.extend(np.zeros(64) for _ in range(times)), 10_000) > 2**20
