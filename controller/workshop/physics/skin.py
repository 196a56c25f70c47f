"""What a focus may do to the skin that rests on it: an illustration of the paper's section VI, not a model of a finger.

A mass lies on the plate, pressed by a viscoelastic pulp behind it. The contact is one-sided: it pushes, and never pulls. The plate
gives way with the impedance of an infinite plate at a point, Z = 8 sqrt(D rho h) (paper, appendix C), so while they touch
`m v' = Z (u' - v) - k x - c v`, with the velocity u' that the plate would have without finger: eq. (7)'s low-pass of Z / M, with a
pulp. When the force `F + Z (u' - v)` falls to zero the skin leaves, decelerated by F and the pulp; when it comes down it stays.

The numbers of the pulp come from literature, measured along the skin and below 1 kHz, and are not fitted to anything here.
What is left out: that skin is a continuum which moves less the deeper and the faster, air under it, the plate's edges.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from controller.arrays import Floats

RELATIVE_ERROR = 1e-6  # of a step: a throw is within 1e-3
ABSOLUTE_ERROR = (1e-11, 1e-6, 1e-11)  # m, m/s, m
LONGEST_STEP_S = 4e-6  # 4 steps in a period of 70 kHz: a leap of the skin between two steps is not missed
MOST_PHASES = 10_000


@dataclass(frozen=True)
class Pulp:
    """Skin and what is behind it."""

    # mass_kg, stiffness_n_m, damping_kg_s: m, k and c; by default of a finger pad as in Konyo et al.'s simulation of
    # vibrotactile friction (ROBOMECH J. 4, 2017, table 1: 0.1 g, 1 N/mm, 1 N s/m). The paper has 70 to 230 mg from literature,
    # 0 to 100 measured
    mass_kg: float = 1e-4
    stiffness_n_m: float = 1e3
    damping_kg_s: float = 1.0
    press_n: float = 0.5  # F, with which the finger presses; 0.5 N is the middle of the paper's fig. 11, and fig. 12 does not tell


@dataclass(frozen=True, eq=False)
class SkinMotion:
    """Motion of skin and plate, from rest in contact."""

    time_s: Floats  # (time,)
    skin_m: Floats  # skin_m, plate_m: (time,): from their place at rest, upwards
    plate_m: Floats
    velocity_m_s: Floats  # (time,): of the skin
    force_n: Floats  # (time,): of the contact; never negative, 0 in flight
    flights_s: Floats  # (flight, 2): when the skin left and when it came back; a last flight that goes on ends with the simulation

    def longest_flight(self) -> tuple[float, float, float]:
        """Longest flight: duration in s, largest displacement of the skin and largest gap to the plate in it, in m."""
        if not len(self.flights_s):
            return 0.0, 0.0, 0.0
        left_s, back_s = self.flights_s[int(np.argmax(self.flights_s[:, 1] - self.flights_s[:, 0]))]
        inside = (self.time_s >= left_s) & (self.time_s <= back_s)
        return float(back_s - left_s), float(self.skin_m[inside].max()), float((self.skin_m - self.plate_m)[inside].max())


def skin_motion(
    velocity_m_s: Callable[[float], float],  # velocity of the free plate at the focus at a time in s; smooth
    impedance_kg_s: float,  # Z, force over velocity of the plate at a point
    pulp: Pulp,
    until_s: float,  # end of the simulation
    *,
    relative_error: float = RELATIVE_ERROR,  # relative_error, longest_step_s: of the integration
    longest_step_s: float = LONGEST_STEP_S,
) -> SkinMotion:
    """Move the skin from rest at time 0; raises RuntimeError if the skin leaves and comes back more than `MOST_PHASES` times."""
    phases = _Phases(velocity_m_s, impedance_kg_s, pulp)
    leaves, lands = _event(phases.push), _event(lambda _t, state: float(state[0] - state[2]))
    now_s, state, contact = 0.0, np.zeros(3), True
    parts: list[tuple[Floats, Floats, Floats]] = []
    flights: list[tuple[float, float]] = []
    for _ in range(MOST_PHASES):
        solved = solve_ivp(
            phases.touching if contact else phases.flying,
            (now_s, until_s),
            state,
            events=leaves if contact else lands,
            rtol=relative_error,
            atol=ABSOLUTE_ERROR,
            max_step=longest_step_s,
        )
        force = np.array([phases.push(t, at) if contact else 0.0 for t, at in zip(solved.t, solved.y.T, strict=True)])
        parts.append((solved.t, solved.y, np.maximum(force, 0.0)))  # zero but for rounding where it leaves
        if not contact:
            flights.append((now_s, float(solved.t[-1])))
        if solved.status == 0:
            break
        now_s, state = float(solved.t[-1]), solved.y[:, -1].copy()
        contact = not contact
        if contact:
            state[2] = state[0]
    else:
        raise RuntimeError(f"the skin left the plate and came back more than {MOST_PHASES // 2} times in {now_s:g} s")
    time_s, states, force_n = (np.concatenate(some, axis=-1) for some in zip(*parts, strict=True))
    return SkinMotion(time_s, states[0], states[2], states[1], force_n, np.array(flights).reshape(-1, 2))


class _Phases(NamedTuple):
    """Equations of motion in contact and in flight; the state is the skin's displacement and velocity, the plate's displacement."""

    velocity_m_s: Callable[[float], float]
    impedance_kg_s: float
    pulp: Pulp

    def push(self, t: float, state: Floats) -> float:
        """Force of the contact while they touch."""
        return float(self.pulp.press_n + self.impedance_kg_s * (self.velocity_m_s(t) - state[1]))

    def touching(self, t: float, state: Floats) -> list[float]:
        """Derivative of the state in contact."""
        x, v, _ = state
        pulp = self.pulp
        return [v, (self.push(t, state) - pulp.press_n - pulp.stiffness_n_m * x - pulp.damping_kg_s * v) / pulp.mass_kg, v]

    def flying(self, t: float, state: Floats) -> list[float]:
        """Derivative of the state in flight: relieved of F, the plate rises."""
        x, v, _ = state
        pulp = self.pulp
        braked = (-pulp.press_n - pulp.stiffness_n_m * x - pulp.damping_kg_s * v) / pulp.mass_kg
        return [v, braked, self.velocity_m_s(t) + pulp.press_n / self.impedance_kg_s]


def _event(function: Callable[[float, Floats], float]) -> Callable[[float, Floats], float]:
    """The same function as an event of `solve_ivp` that ends a phase where it falls through zero."""

    def falls(t: float, state: Floats) -> float:
        return function(t, state)

    falls.terminal, falls.direction = True, -1  # type: ignore[attr-defined]
    return falls
