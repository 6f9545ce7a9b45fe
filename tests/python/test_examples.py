"""The examples do what they say."""

import os
import re
import subprocess
import sys

import pytest

from conftest import SOURCE

FOLDER = SOURCE / "plugin" / "python" / "examples"


def run(name, tmp_path, **environment):
    done = subprocess.run([sys.executable, "-W", "error", str(FOLDER / name)], cwd=tmp_path, capture_output=True, text=True,
                          env={**os.environ, **environment})
    assert done.returncode == 0, done.stderr
    return done.stdout


def number(pattern, text):
    return float(re.search(pattern, text).group(1))


def test_hello(tmp_path):
    text = run("01_hello.py", tmp_path)
    assert number(r"torques up to (\d+) N·m", text) > 30
    assert number(r"they step by ([\d.]+) N·m", text) < 0.5


def test_own_demonstration(tmp_path):
    text = run("02_own_demonstration.py", tmp_path)
    assert number(r"within ([\d.]+) mm", text) <= 1.0
    now, was = number(r"at x = ([\d.]+) m", text), number(r"ended at ([\d.]+) m", text)
    assert now - was == pytest.approx(0.1, abs=5e-3)


def test_pybullet(tmp_path):
    try:
        import pybullet  # noqa: F401
    except ImportError:  # what stands in for it
        (tmp_path / "pybullet.py").write_text("from stand_in import *\nfrom stand_in import error\n")
    path = os.pathsep.join([str(tmp_path), os.path.dirname(__file__), os.environ["PYTHONPATH"]])
    text = run("03_pybullet.py", tmp_path, PYTHONPATH=path)
    assert "motors off" in text
    assert number(r"further than (\S+) rad", text) < 1e-9


def test_goal_from_a_sensor(tmp_path):
    text = run("04_goal_from_a_sensor.py", tmp_path)
    assert number(r"([\d.]+) rad from the target", text) < 0.01
    assert number(r"more than (\S+) rad/s²", text) < 1e-6


def test_four_methods(tmp_path):
    pytest.importorskip("matplotlib")
    text = run("05_four_methods.py", tmp_path)
    jump = {method: number(rf"{method} +([\d.]+)", text) for method in ("dmp2", "dmp2a", "dmp3", "dmp2j")}
    assert jump["dmp2"] > 1.0 and max(jump["dmp2a"], jump["dmp3"], jump["dmp2j"]) < 0.02 * jump["dmp2"]
    assert (tmp_path / "four_methods.png").stat().st_size > 20_000


def test_all_are_run():
    assert len(list(FOLDER.glob("*.py"))) == sum(name.startswith("test_") for name in globals()) - 1


def test_wishes(tmp_path):
    pytest.importorskip("matplotlib")
    text = run("06_wishes.py", tmp_path)
    first = re.search(r"^ +0\.50 +([\d.]+), ([\d.]+)", text, re.M)
    assert 0.09 < float(first.group(1)) < 0.13
    assert re.search(r"^ +0\.02 +refused +refused +refused +refused", text, re.M)
    assert (tmp_path / "wishes.png").stat().st_size > 20_000
