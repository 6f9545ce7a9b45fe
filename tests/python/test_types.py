"""The stubs are those of the module, and users' code is checked against them."""

import pathlib
import subprocess
import sys

import pytest

import seam

pytest.importorskip("mypy")
PACKAGE = pathlib.Path(seam.__file__).parent


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """Runs it; what it has found out about numpy is kept from one run to the next."""
    cache = str(tmp_path_factory.mktemp("cache"))
    environment = {"MYPYPATH": str(PACKAGE.parent), "PYTHONPATH": str(PACKAGE.parent), "PATH": "/usr/bin:/bin",
                   "MYPY_CACHE_DIR": cache}
    return lambda *arguments: subprocess.run([sys.executable, "-m", "mypy", *arguments], capture_output=True, text=True,
                                             cwd=cache, env=environment)


GOOD = """
import numpy as np
import seam
t = np.linspace(0, 1, 101)
reach = seam.learn(seam.Demonstration(t, {"E1": t**2}), kind="discrete", kernels=12)
task = seam.Sequence().then(reach, until=seam.before_end(0.4)).then(reach)
arm = seam.RobotModel.read("arm.urdf", package_path=["/opt"])
settings = seam.ArmControllerSettings(law=seam.ControlSettings(Kp=[1.0] * 7, reference="plain"))
control = seam.ArmController(arm, task, join=seam.JoinSettings("dmp2a"), settings=settings, q=[0.0] * 7)
torque: float = control.tick(1e-3, t, t)[0]
goal: float = control.sequencer.goal[0]
arm.joints[0].damping = 2.0
path = seam.rollout(task, "dmp3", dt=1e-3)
column = path.ref["E1"]
jump: float = seam.measure(seam.play("carrying", method="dmp2", arm="published")).torque_jump_nm
status: seam.ArmController.Status = control.status
figure = seam.plot(path)
"""
BAD = ["seam.learn(3)", "seam.Gains(K='stiff')", "seam.before_end()", "seam.no_such_name", "x: str = seam.Gains().K",
       "seam.Sequence().then(until=seam.at_end())", "seam.Scene.read('line').dt = 3", "seam.play('line', method=3.5)"]


def test_good_code_passes_and_so_does_the_package(mypy, tmp_path):
    assert (PACKAGE / "py.typed").exists()
    (tmp_path / "good.py").write_text(GOOD)
    done = mypy("--strict", "--follow-imports=silent", str(tmp_path / "good.py"))
    assert done.returncode == 0, done.stdout
    done = mypy("-p", "seam")
    assert done.returncode == 0, done.stdout


def test_every_slip_is_found(mypy, tmp_path):
    (tmp_path / "bad.py").write_text("\n".join(["import seam", *BAD]))
    done = mypy("--follow-imports=silent", str(tmp_path / "bad.py"))
    lines = {int(line.split(":")[1]) for line in done.stdout.splitlines() if ": error:" in line}
    assert lines == set(range(2, len(BAD) + 2)), done.stdout


def test_stubs_have_what_the_module_has():
    """Nothing is lacking, and no signature differs."""
    done = subprocess.run([sys.executable, "-m", "mypy.stubtest", "seam._seam"], capture_output=True, text=True, cwd=PACKAGE.parent,
                          env={"MYPYPATH": str(PACKAGE.parent), "PYTHONPATH": str(PACKAGE.parent), "PATH": "/usr/bin:/bin"})
    errors = [line for line in done.stdout.splitlines() if line.startswith("error:")]
    assert len(errors) > 10, done.stdout + done.stderr  # it has compared them: pybind11's metaclass is one
    harmless = ("metaclass differs", "stub does not have *args argument", "__copy__", "__deepcopy__", "__entries")
    assert [line for line in errors if not any(part in line for part in harmless)] == []
