"""Bands from 1 to 400 kHz: every mode of the band is computed, by the bank, by `focus` and by the twin alike."""

import numpy as np
import pytest
from stress.boards import changed, focus_on

from controller.device.bank.packing import channel_bits
from controller.device.bank.reader import Bank
from controller.workshop.bank_builder.build import build_bank
from controller.workshop.bank_builder.request import BankRequest
from controller.workshop.physics.plate import mode_cut_hz
from controller.workshop.physics.plate_twin import PlateTwin
from controller.workshop.physics.responses.impulse_response import ResponseModel


def with_band(board, low_hz, high_hz, bit_clock_hz, **plate):
    waveform = {
        "band_low_hz": low_hz,
        "band_high_hz": high_hz,
        "bit_clock_hz": bit_clock_hz,
        "duration_ms": 400 / bit_clock_hz * 1e3,
    }
    return changed(board, waveform=waveform, plate=plate, limits={"max_edge_rate_hz": bit_clock_hz, "min_pulse_us": 0.4})


LONG = pytest.mark.stress
BANDS = [
    pytest.param((1e3, 5e3, 100e3), marks=LONG),
    pytest.param((20e3, 70e3, 500e3), marks=LONG),
    (105e3, 125e3, 500e3),
    pytest.param((200e3, 400e3, 2e6), marks=LONG),
]


@pytest.mark.parametrize("band", BANDS, ids=lambda band: f"{band[0] / 1e3:g}-{band[1] / 1e3:g}_kHz")
def test_bank_focus_and_twin_have_the_modes_of_the_band(board, tmp_path, band):
    """Before, all stopped at 100 kHz: above it the focus was of nothing."""
    panel = with_band(board, *band, thickness_mm=3.0)  # a sixth of the modes
    cut_hz = mode_cut_hz(panel)
    model, twin = ResponseModel(panel), PlateTwin(panel)
    assert band[1] * 1.2 < model.plate_modes.angular_frequency[-1] / (2 * np.pi) <= cut_hz
    assert np.array_equal(model.plate_modes.angular_frequency, twin.modes.angular_frequency)
    build_bank(BankRequest(panel, tmp_path / "bank", 70e-3))
    with Bank.open(tmp_path / "bank", panel) as bank:
        assert bank.header.parameters["highest_hz"] == cut_hz
        place = bank.grid.place(0)
        played = channel_bits(np.frombuffer(bank.drive.words(0), "<u4"))
    more = ResponseModel(panel, 1.5 * cut_hz)
    in_band, whole = (some[0] for some in (more.drive_order_responses([place], dtype=np.float64), more.responses([place])[:, ::-1]))
    assert np.vdot(2.0 * played - 1, in_band) > 0.99 * np.abs(in_band).sum(), (
        "what the bank plays is the sign of the band's response"
    )
    _, (row,) = focus_on(panel, [place])
    above_idle = played - channel_bits(np.array([panel.idle_word], "<u4")).astype(float)
    reached_um = 1e6 * panel.driver.supply_v * np.vdot(above_idle, whole)
    assert row["amplitude_um"] == pytest.approx(reached_um, rel=0.01), "the twin moves as far, and modes above the cut add nothing"
    assert row["relative_amplitude"] == pytest.approx(1, abs=1e-6)
