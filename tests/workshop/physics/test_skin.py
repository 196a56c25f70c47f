"""Skin on the plate: what no parameter may change (no pull, momentum, energy), limits with closed forms, convergence."""

import numpy as np
import pytest

from controller.workshop.physics.skin import Pulp, skin_motion

Z = 8.0  # kg/s, of the paper's plate
HZ, AT_REST_S = 45e3, 40e-6
FREE = Pulp(mass_kg=1e-4, stiffness_n_m=0.0, damping_kg_s=0.0, press_n=0.5)


def pulse(t):
    """Velocity of a focus of 7.7 µm that passes by: a wave of 45 kHz under a bell of 12 µs."""
    since = t - AT_REST_S
    bell = np.exp(-((since / 12e-6) ** 2))
    return (
        7.7e-6 * bell * (-2 * np.pi * HZ * np.sin(2 * np.pi * HZ * since) - 2 * since / 12e-6**2 * np.cos(2 * np.pi * HZ * since))
    )


def gentle(t):
    return pulse(t) / 100


def moved(pulp, until_s=3e-4, velocity=pulse, **how):
    return skin_motion(velocity, Z, pulp, until_s, **how)


def test_the_contact_pushes_and_never_pulls_and_the_skin_is_never_below_the_plate():
    motion = moved(Pulp())
    assert motion.force_n.min() == 0.0
    assert len(motion.flights_s) >= 1
    assert (motion.skin_m - motion.plate_m).min() > -1e-12
    for left_s, back_s in motion.flights_s:
        inside = (motion.time_s > left_s) & (motion.time_s < back_s)
        assert not motion.force_n[inside].any()


def test_momentum_of_the_skin_is_the_impulse_of_all_forces():
    """Contact, press and pulp; trapezoids over steps of 0.1 µs leave 3e-4 of the momentum."""
    pulp = Pulp()
    motion = moved(pulp, longest_step_s=1e-7)
    force = motion.force_n - pulp.press_n - pulp.stiffness_n_m * motion.skin_m - pulp.damping_kg_s * motion.velocity_m_s
    impulse = np.concatenate([[0.0], np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(motion.time_s))])
    momentum = pulp.mass_kg * motion.velocity_m_s
    error = abs(impulse - momentum).max() / abs(momentum).max()
    print(f"momentum: off by {error:.1e} of the largest")
    assert error < 5e-4
    assert abs(1.01 * impulse - momentum).max() / abs(momentum).max() > 3e-3


def test_energy_is_kept_in_flight_without_damping():
    pulp = Pulp(damping_kg_s=0.0)
    motion = moved(pulp)
    left_s, back_s = max(motion.flights_s, key=lambda flight: flight[1] - flight[0])
    inside = (motion.time_s >= left_s) & (motion.time_s <= back_s)
    x, v = motion.skin_m[inside], motion.velocity_m_s[inside]
    energy = pulp.mass_kg / 2 * v**2 + pulp.stiffness_n_m / 2 * x**2 + pulp.press_n * x
    error = np.ptp(energy) / energy.max()
    print(f"energy in flight: {error:.1e} of it changes")
    assert error < 1e-6


def test_free_flight_is_a_parabola_of_the_press_and_with_a_spring_a_part_of_a_sine():
    for stiffness_n_m in (0.0, 1e3):
        pulp = Pulp(mass_kg=1e-4, stiffness_n_m=stiffness_n_m, damping_kg_s=0.0, press_n=0.5)
        motion = moved(pulp)
        left_s, back_s = max(motion.flights_s, key=lambda flight: flight[1] - flight[0])
        inside = (motion.time_s >= left_s) & (motion.time_s <= back_s)
        t = motion.time_s[inside] - left_s
        x0, v0 = motion.skin_m[inside][0], motion.velocity_m_s[inside][0]
        omega, rest = (stiffness_n_m / pulp.mass_kg) ** 0.5, -pulp.press_n / (stiffness_n_m or 1.0)
        if omega:
            expected = rest + (x0 - rest) * np.cos(omega * t) + v0 / omega * np.sin(omega * t)
        else:
            expected = x0 + v0 * t - pulp.press_n / pulp.mass_kg * t**2 / 2
        error = abs(motion.skin_m[inside] - expected).max() / expected.max()
        print(f"flight with {stiffness_n_m:g} N/m: {error:.1e} of its height off the closed form")
        assert error < 1e-6


def test_skin_that_never_leaves_moves_by_the_low_pass_of_equation_7():
    """Without pulp: x = U Z / (Z + i w M), by an inverse Fourier transform; the gentle pulse of a hundredth never leaves."""
    motion = moved(FREE, velocity=gentle, longest_step_s=2e-7)
    assert not len(motion.flights_s)
    count, step_s = 1 << 14, 1e-7
    time_s = np.arange(count) * step_s
    velocity = np.fft.rfft(gentle(time_s))
    omega = 2 * np.pi * np.fft.rfftfreq(count, step_s)
    expected = np.fft.irfft(velocity * Z / (Z + 1j * omega * FREE.mass_kg), count)
    found = np.interp(time_s[:2500], motion.time_s, motion.velocity_m_s)
    error = abs(found - expected[:2500]).max() / abs(expected).max()
    print(f"contact: {error:.1e} off eq. (7)'s low-pass")
    assert error < 1e-3  # linear interpolation over steps of 0.2 µs: (w dt)^2 / 8 is 4e-4
    heavier = np.fft.irfft(velocity * Z / (Z + 1.05j * omega * FREE.mass_kg), count)
    assert abs(found - heavier[:2500]).max() / abs(expected).max() > 2e-2


def test_skin_on_a_plate_that_does_not_give_way_moves_with_it_until_it_leaves():
    motion = skin_motion(gentle, 100 * Z, Pulp(press_n=50.0), 1e-4)
    assert not len(motion.flights_s)
    assert motion.skin_m.max() == pytest.approx(7.7e-8, rel=3e-3)  # w M / Z is 0.035: 6e-4 less, a tenth of a µs late


def test_the_throw_converges():
    """A hundredth of the tolerance, a quarter of the step: the flight changes by less than a thousandth."""
    exact = moved(Pulp(), relative_error=1e-8, longest_step_s=1e-6).longest_flight()
    used = moved(Pulp()).longest_flight()
    print(f"flight {exact[0] * 1e3:.4f} ms, {exact[1] * 1e6:.3f} µm; as used {used[0] * 1e3:.4f} ms, {used[1] * 1e6:.3f} µm")
    assert used[0] == pytest.approx(exact[0], rel=1e-3)
    assert used[1] == pytest.approx(exact[1], rel=1e-3)


def test_who_presses_harder_is_thrown_less():
    heights = [moved(Pulp(press_n=press_n), until_s=6e-4).longest_flight() for press_n in (0.2, 0.5, 1.0)]
    assert [flight for flight, _, _ in heights] == sorted((flight for flight, _, _ in heights), reverse=True)
