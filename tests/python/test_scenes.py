"""Scenes from Python are those of the program."""

import math
import os
import subprocess

import numpy as np
import pytest

import seam


def test_a_run_has_the_bytes_of_the_programs(tmp_path):
    run = seam.play("line", method="dmp2a", dt=2e-3)
    run.write(str(tmp_path / "python.csv"))
    subprocess.run([os.environ["SEAM_PROGRAM"], "run", "line", "--method", "dmp2a", "--dt", "0.002", "--out", str(tmp_path / "out")],
                   check=True, stdout=subprocess.DEVNULL)
    [written] = (tmp_path / "out").rglob("dmp2a.csv")
    assert (tmp_path / "python.csv").read_bytes() == written.read_bytes()


def test_settings_are_those_of_set():
    ideal = seam.measure(seam.play("line", method="dmp2", dt=2e-3))
    fast = seam.measure(seam.play("line", method="dmp2", dt=2e-3, speed=1.5))
    by_key = seam.measure(seam.play("line", method="dmp2", dt=2e-3, set={"speed": 1.5}))
    assert fast.torque_jump_nm == by_key.torque_jump_nm > 1.5 * ideal.torque_jump_nm
    published = seam.play("line", method="dmp3", dt=2e-3, arm="published", control={"observer": 40})
    assert published.outcomes["stopped_share"] == 0.0
    assert seam.measure(published).tracking_max_rad > 1e-6


def test_a_scene_is_read_and_looked_at():
    scene = seam.Scene.read("carrying", ["speed=0.9"])
    assert scene.name == "carrying" and scene.speed == 0.9 and scene.arm == "ideal"
    assert scene.robot.dof == 7 and scene.start.shape == (7,)
    assert scene.tool is not None and len(scene.sequence) == 2 == len(scene.primitive_names)
    control = seam.ArmController(scene.robot, scene.sequence, "dmp3", scene.settings, q=scene.start)
    assert control.tick(1e-3, scene.start, np.zeros(7)).shape == (7,)
    run = seam.play(scene, dt=4e-3)
    assert math.isfinite(run.outcomes["spilled_share"])
    assert {"line", "carrying", "wiping", "pouring", "catching"} <= set(seam.scenes())


def test_events_happen_to_a_sequencer():
    seen = "{from: 0.4, to: 1.2, every: 0.1, goal: {E1: 1.3}, velocity: {E1: 0.1}, noise: 0.002}"
    scene = seam.Scene.read("line", [f"events=[{seen}]"])
    assert scene.events and scene.events[0].what == seam.Event.What.goal
    sequencer = seam.Sequencer(scene.sequence, "dmp2a")
    for event in scene.events[:3]:
        while sequencer.time < event.at:
            sequencer.step(1e-3)
        assert event.happen(sequencer)
    wanted = scene.events[2].goal
    np.testing.assert_array_equal(sequencer.goal[np.isfinite(wanted)], wanted[np.isfinite(wanted)])


def test_a_ball_that_is_seen_moves_the_hit():
    scene = seam.Scene.read("catching")
    assert len(scene.events) > 3
    for event in scene.events:
        assert event.what == seam.Event.What.hit and event.which == 0
        assert event.goal.shape == event.velocity.shape == (3,) and event.when > event.at
    run = seam.play(scene)
    assert run.outcomes["miss_m"] < 0.005


def test_the_same_twice():
    runs = [seam.play("line", method="dmp2j", dt=4e-3) for _ in range(2)]
    np.testing.assert_array_equal(runs[0].torque, runs[1].torque)


def test_playing_lets_other_threads_go_on():
    import threading

    turns, over = 0, threading.Event()
    thread = threading.Thread(target=lambda: (seam.play("line", method="dmp3"), over.set()))
    thread.start()
    while not over.wait(0.0005):
        turns += 1
    thread.join()
    assert turns > 5
