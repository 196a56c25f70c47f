"""How loud a panel is, in dB(A) at 0.3 m: one emission, trains of them, arming; printed by `focus` and `bank info --power`."""

from typing import Any

import numpy as np

from controller.arrays import Bools, Words
from controller.device.bank.packing import drive_words
from controller.device.board.board import Board
from controller.workshop.gateware.model.pins import ramp_bits
from controller.workshop.physics.sound import PlateSound, decibels

Figures = dict[str, Any]

RATES_HZ = (50, 200)  # of a train that buzzes, and of one that hums


def sound_figures(board: Board, sound: PlateSound, words: Words) -> Figures:
    """Levels of an emission, A-weighted, mean over a half sphere of 0.3 m.

    `exposure_db`: of one, and the return to the idle word (sound exposure level, dB re 400 uPa^2 s); a sound level meter set to
    fast shows 9 dB more at most. `train_50_hz_db`, `train_200_hz_db`: of endless trains (LAeq), where the emission is short enough.
    `arming_exposure_db`: of the ramp from 0 V to the idle word.
    """
    trains = {
        f"train_{rate_hz}_hz_db": sound.repeated_db(words, board.idle_word, rate_hz)
        for rate_hz in RATES_HZ
        if rate_hz * board.waveform.duration_s <= 1
    }
    ramp = ramp_words(board, ramp_bits(ramp_samples(board, board.limits.ramp_ms), up=True))
    return {
        "exposure_db": decibels(sound.exposure_pa2_s(words, board.idle_word)),
        **trains,
        "arming_exposure_db": decibels(sound.exposure_pa2_s(ramp, board.idle_word, before_word=0)),
    }


def ramp_samples(board: Board, ramp_ms: float) -> int:
    """Length of a ramp of `ramp_ms` in samples, rounded as the session rounds it for the FPGA."""
    return max(1, round(ramp_ms * 1e-3 * board.waveform.bit_clock_hz))


def ramp_words(board: Board, bits: Bools) -> Words:
    """Drive words of a ramp: the idle word where the ramp's bit is high, else 0."""
    idle = [board.idle_word >> channel & 1 for channel in range(board.channels)]
    return drive_words(np.outer(bits, idle))
