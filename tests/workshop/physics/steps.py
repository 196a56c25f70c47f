"""Values in time of the sums of exponentials that driver and plate keep as poles and residues."""

import numpy as np


def step_voltage(response, time_s):
    """Piezo voltage of a `DriverResponse` at times from a unit step on."""
    return 1 + (np.exp(np.multiply.outer(np.asarray(time_s), response.poles)) @ response.residues).real


def step_displacement(step, time_s):
    """Each mode of a `StepResponse` in m per N at one time after the step."""
    of_poles = (step.residues * np.exp(step.poles * time_s)).real
    of_driver = (step.driver_residues @ np.exp(step.driver_poles * time_s)).real
    return step.static + step.by_mode(of_poles) + of_driver
