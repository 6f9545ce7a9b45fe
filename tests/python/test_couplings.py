"""Couplings, of C++ and of one's own, against each other and against what they should be."""

import gc
import sys

import numpy
import pytest

import seam


def hand():
    time = numpy.linspace(0.0, 1.0, 501)
    way = time**3 * (10.0 + time * (-15.0 + 6.0 * time))
    return seam.Sequence().then(seam.learn(seam.Demonstration(time, {"x": 0.3 * way, "y": 0.0 * way, "z": 0.0 * way})))


def nearest(task, obstacle, avoids):
    sequencer = seam.Sequencer(task, "dmp3")
    if avoids:
        sequencer.add_coupling(obstacle)
    least = numpy.inf
    for _ in range(2000):
        sequencer.step(1e-3)
        least = min(least, obstacle.distance(sequencer.sample.position, sequencer.motion_time))
    return least


@pytest.mark.parametrize("shape", [seam.Steering(), seam.Ball(radius=0.03), seam.Box(size=[0.03, 0.03, 0.03])])
def test_a_hand_keeps_away(shape):
    obstacle = seam.Obstacle(["x", "y", "z"], seam.ObstacleSettings(at=[0.15, 0.02, 0.0], shape=shape))
    assert nearest(hand(), obstacle, False) < 0.021
    assert nearest(hand(), obstacle, True) > 0.03


class Drag(seam.Coupling):
    def add(self, y, yd, t):
        return -2.0 * yd + numpy.sin(t)


def test_ones_own_is_in_the_equation_of_motion_and_lives_with_the_sequencer():
    sequencer = seam.Sequencer(hand(), "dmp2a")
    sequencer.step(0.3)
    before = sequencer.sample
    sequencer.add_coupling(Drag())
    gc.collect()
    acts = -2.0 * before.velocity + numpy.sin(0.3)
    numpy.testing.assert_allclose(sequencer.sample.acceleration, before.acceleration + acts, atol=1e-12)
    assert isinstance(sequencer.couplings[0], Drag)
    assert sequencer.remove_coupling(sequencer.couplings[0])
    assert sequencer.couplings == ()
    numpy.testing.assert_allclose(sequencer.sample.acceleration, before.acceleration, atol=1e-12)
    assert not sequencer.remove_coupling(Drag())
    with pytest.raises(seam.Error, match="a coupling is None"):
        sequencer.add_coupling(None)


def test_ones_own_moves_as_an_independent_solution():
    """τ²ÿ = K(g − y) − τDẏ + τ²·C without forcing, by RK4 in small steps."""
    primitive = hand().steps[0].primitive
    primitive.weights = numpy.zeros_like(primitive.weights)
    execution = seam.Execution(primitive)
    execution.couple(Drag(), 0.25)
    gains, tau, goal = primitive.gains, primitive.tau, numpy.array(primitive.goal)
    y, yd = numpy.array(execution.sample.position), numpy.array(execution.sample.velocity)

    def slope(y, yd, t):
        return yd, (gains.K * (goal - y) - tau * gains.D * yd) / tau**2 - 2.0 * yd + numpy.sin(t)

    h = 1e-3
    for k in range(500):
        execution.step(h)
        for i in range(2):
            t = 0.25 + (k + 0.5 * i) * h
            a = slope(y, yd, t)
            b = slope(y + h / 4 * a[0], yd + h / 4 * a[1], t + h / 4)
            c = slope(y + h / 4 * b[0], yd + h / 4 * b[1], t + h / 4)
            d = slope(y + h / 2 * c[0], yd + h / 2 * c[1], t + h / 2)
            y, yd = (x + h / 12 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip((y, yd), a, b, c, d))
    numpy.testing.assert_allclose(execution.sample.position, y, atol=1e-10)
    execution.couple(None, 0.0)


def test_what_ones_own_raises_is_reported_and_adds_nothing(monkeypatch):
    class Wrong(seam.Coupling):
        def add(self, y, yd, t):
            raise KeyError("lost")

    class TooShort(seam.Coupling):
        def add(self, y, yd, t):
            return [1.0]

    seen = []
    monkeypatch.setattr(sys, "unraisablehook", lambda report: seen.append(report.exc_type))
    for wrong, kind in ((Wrong(), KeyError), (TooShort(), ValueError)):
        seen.clear()
        coupled, plain = (seam.Sequencer(hand(), "dmp3") for _ in range(2))
        coupled.add_coupling(wrong)
        coupled.step(0.01)
        plain.step(0.01)
        assert set(seen) == {kind}
        numpy.testing.assert_allclose(coupled.sample.position, plain.sample.position, atol=1e-14)


def test_obstacles_of_a_file(tmp_path):
    settings = seam.ObstacleSettings(
        [0.1, 0.2, 0.3], seam.Ball(0.05), appears=seam.Fading(0.5, 0.2), moves=seam.Moving([0.1, 0.3, 0.3], 1.0, 0.5))
    file = seam.SequenceFile(hand(), ["reach"], couplings=[settings])
    seam.write_sequence(tmp_path / "coupled.yaml", file)
    back = seam.read_sequence(tmp_path / "coupled.yaml")
    sequencer = seam.Sequencer(back.sequence, "dmp3", back.start_state())
    (obstacle,) = seam.add_obstacles(back.couplings, sequencer)
    assert sequencer.couplings == (obstacle,)
    assert obstacle.presence(0.6) == pytest.approx(0.5)
    numpy.testing.assert_allclose(obstacle.position(9.0), [0.1, 0.3, 0.3])
    assert obstacle.vanish(2.0, 0.1) and not obstacle.vanish(2.0, -1.0)
    assert settings.at_speed(2.0).moves.from_ == 0.5
    at, d = numpy.array([0.1, 0.3, 0.4]), 1e-6
    push = obstacle.add(at, [0.0, 0.0, 0.0], 1.9)
    slope = [(obstacle.potential(at + d * e, 1.9) - obstacle.potential(at - d * e, 1.9)) / (2 * d) for e in numpy.eye(3)]
    numpy.testing.assert_allclose(push, -numpy.array(slope), atol=1e-6)
    with pytest.raises(seam.Error, match="there is no coordinate x among q"):
        seam.Obstacle(["q"], settings)
