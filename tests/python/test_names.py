"""What C++ has, Python has: every public name of the headers of core, files and arm, but those that are left out on purpose."""

import inspect
import sys

import pytest

import seam
from conftest import SOURCE

sys.path.insert(0, str(SOURCE / "plugin" / "python"))
import headers  # noqa: E402

# Whole headers, and single names, with the reason.
LEFT_OUT_HEADERS = {
    "alignment.hpp": "of compiled code alone",
    "conditions.hpp": "a part of Execution; numpy.linalg.lstsq does it",
    "compensated_sum.hpp": "a part of the sequencer; Python has math.fsum",
    "export.hpp": "of compiled code alone",
    "glide.hpp": "a part of Obstacle",
    "noise.hpp": "a part of the sensor; numpy has its own",
    "posture_system.hpp": "a part of InverseKinematics",
    "precision.hpp": "of compiled code alone: the module is linked with Bullet in double",
    "propagator.hpp": "a part of Execution",
    "quintic.hpp": "three polynomials: one line of numpy each",
    "table.hpp": "numpy and pandas read CSV files",
    "whole_file.hpp": "Python writes files; seam's own are written whole",
}
LEFT_OUT = {
    "Basis::forcing": "reads padded memory; use regressor(phase) @ weights",
    "Companions": "keywords of measure",
    "Execution::last_moment": "a part of the sequencer",
    "Followers": "RobotModel.place_followers does it",
    "JointReference": "JointSpace and TaskSpace have its methods",
    "NoJump::NoJump": "made by TorqueIsContinuousAt and its like",
    "NoJump::Of": "likewise",
    "Outcome": "entries of the dict Recording.outcomes",
    "PerJoint": "a number or an array",
    "PrintTo": "of GoogleTest",
    "Reached": "a part of the sequencer",
    "RecordingMatcher": "of GoogleTest",
    "Sample::swap": "Python exchanges names",
    "Signal": "entries of the dict Recording.signals",
    "due": "a part of the sequencer",
    "operator*": "Inertial.seen_from",
    "phase_of": "a part of the sequencer",
    "require_reference": "a check that learn, then and read_primitive make",
    "require_same_reference": "likewise",
    "to_string": "Join.name",
}
# In Python otherwise.
CALLED = {"operator+": "Inertial.__add__"}
NAMES = headers.declarations(sorted(path for folder in ("core", "files", "arm")
                                    for path in (SOURCE / "plugin" / folder / "include" / "seam").glob("*.hpp")))


def is_left_out(one):
    parts = one.name.split("::")
    return one.header in LEFT_OUT_HEADERS or any("::".join(parts[: i + 1]) in LEFT_OUT for i in range(len(parts)))


def is_made_or_moved(one):
    """Constructors are the class's own call; Python copies, moves and destroys by itself."""
    parts = one.name.split("::")
    last = parts[-1]
    return (len(parts) > 1 and last == parts[-2]) or last.startswith("~") or last in ("operator=", "operator()")


def find(name):
    thing = seam
    for part in CALLED.get(name, name.replace("::", ".")).split("."):
        thing = inspect.getattr_static(thing, part, None) or inspect.getattr_static(thing, part + "_", None)
        if thing is None:
            return None
        thing = getattr(thing, "__func__", thing)
    return thing


def lacking(names):
    return [one.name for one in names if not is_left_out(one) and not is_made_or_moved(one)
            and find(one.name) is None]


def test_python_has_every_public_name():
    assert len(NAMES) > 600  # the headers were read
    assert lacking(NAMES) == []


def test_a_name_that_is_missing_is_found():
    assert lacking([headers.Declaration("Gains::Q", "field", [], "primitive.hpp")]) == ["Gains::Q"]


def test_what_is_left_out_is_there_in_cpp_and_not_in_python():
    known = {one.name for one in NAMES}
    assert sorted(set(LEFT_OUT) - known) == []
    assert sorted(name for name in LEFT_OUT if find(name) is not None) == []
    assert sorted(set(LEFT_OUT_HEADERS) - {one.header for one in NAMES} - {"alignment.hpp", "export.hpp"}) == []


def public_things():
    for name in seam.__all__:
        thing = getattr(seam, name)
        yield name, thing
        if isinstance(thing, type) and thing.__module__ == "seam" and not issubclass(thing, Exception):
            for key, member in vars(thing).items():
                of_enum = hasattr(thing, "__members__") and key in ("name", "value")
                if not of_enum and not key.startswith("_") and (callable(member) or isinstance(member, (property, staticmethod))):
                    yield f"{name}.{key}", member


@pytest.mark.parametrize("kind", ["function", "property", "class"])
def test_everything_has_a_docstring(kind):
    without = []
    for name, thing in public_things():
        is_kind = {"property": isinstance(thing, property), "class": isinstance(thing, type)}.get(
            kind, callable(thing) and not isinstance(thing, (property, type)))
        if not is_kind or name.startswith("Columns.") or isinstance(thing, staticmethod):
            continue
        doc = inspect.getdoc(thing) or ""
        if kind == "function" and doc.startswith(name.split(".")[-1] + "("):
            doc = doc.partition("\n")[2]
        if not doc.strip():
            without.append(name)
    assert without == []


def test_docstrings_speak_python():
    for name, thing in public_things():
        doc = inspect.getdoc(thing) or ""
        for foreign in ("std::", "Eigen::", "@param", "@return", "@throws", "nullopt"):
            assert foreign not in doc, name
