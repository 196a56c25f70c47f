"""Responses of a compact bank: the compiled kernel gives the bits of its twin, which agrees with sums written out here."""

import numpy as np
import pytest
from compiled_kernels import COMPILED, needs_compiled
from hypothesis import given, settings
from hypothesis import strategies as st
from tables import each_row

from controller.device import kernel
from controller.device.kernel import bank_twin, compact_twin, null_twin, polarity_twin, words_twin

PITCH_M = 4e-3
UNDRIVEN = np.flatnonzero(compact_twin.ORDER == 21)[0]  # where the scale of channel 21 lies among those of a block


def pulses_of(random, outputs, weights, taps):
    """First weights and taps, whose absolute values sum to less than 2^14."""
    found = np.zeros((outputs, 1 + taps), "<i2")
    found[:, 0] = random.integers(0, weights - taps + 1, outputs)
    found[:, 1:] = random.integers(-(1 << 14) // taps + 1, (1 << 14) // taps, (outputs, taps))
    return found


def rows_of(random, cells, layer, stride):
    """Random rows of cells, in which channel 21 has no weight."""
    made = np.frombuffer(random.bytes(cells * stride), np.uint8).reshape(cells, stride).copy()
    made[:, 16 * layer.weights + UNDRIVEN] = 0
    return made.tobytes()


def tables_of(random, samples, in_band, rest, rest_nx, rest_ny, of_band=(0, 0, 0), odd=(2867, 3744)):
    """Tables of a compact bank, with random shares, taps and weights."""
    made = bytearray(compact_twin.HEAD.pack(*in_band, *rest, *odd, rest_nx, rest_ny, 2 * PITCH_M, 7e-3, 8e-3))
    made += compact_twin.OF_BAND.pack(*of_band)
    made += bytes(compact_twin.TABLES_AT - len(made))
    cells = rest_nx * rest_ny
    for layer, outputs in ((in_band, samples // 2 + 2), (rest, bank_twin.rest_rows(samples))):
        half = (layer.across - 1) * layer.steps // 2 + 1
        stencil = random.integers(-8192, 8193, half * half * layer.across**2).astype("<i2")
        for part in (stencil.tobytes(), pulses_of(random, outputs, layer.weights, layer.taps).tobytes()):
            made += part + bytes(-len(part) % 64)
    for part in (
        (10 ** random.uniform(-13, -11, cells)).astype("<f4").tobytes(),
        rows_of(random, cells, rest, compact_twin.row_bytes(rest.weights, rest.block_rows)),
    ):
        made += part + bytes(-len(part) % 64)
    return bytes(made)


def buffers(seed, samples=96, across=4, rest_across=3, taps=(8, 4), idle_word=0x69969669, of_band=(2, 1769, -11973)):
    random = np.random.default_rng(seed)
    nx, ny = random.integers(across, across + 4, 2).tolist()
    rest_nx, rest_ny = random.integers(rest_across, rest_across + 3, 2).tolist()
    weights, rest_weights = max(samples // 4, taps[0]), max(samples // 12, taps[1])
    in_band = compact_twin.PulseLayer(
        across, 2 * int(random.integers(1, 33)), weights, int(random.integers(1, weights + 1)), taps[0]
    )
    rest = compact_twin.PulseLayer(rest_across, 16, rest_weights, min(7, rest_weights), taps[1])
    stride = -(-compact_twin.row_bytes(weights, in_band.block_rows) // 64) * 64
    plan = kernel.PLAN.pack(samples, stride, nx, ny, nx * ny, idle_word, 48, PITCH_M, 5e-3, 6e-3, 0.0, 0.0)
    scales = (10 ** random.uniform(-12, -11, nx * ny)).astype(np.float32)
    bank = kernel.BankBuffers(
        plan,
        np.arange(nx * ny, dtype=np.int32).tobytes(),
        scales.tobytes(),
        bytearray(b"\1" * (nx * ny)),
        rows_of(random, nx * ny, in_band, stride),
        tables_of(random, samples, in_band, rest, rest_nx, rest_ny, of_band),
    )
    return bytearray(4 * samples), bytearray(kernel.room_bytes(samples)), bank


@needs_compiled
@settings(max_examples=60, deadline=None)
@given(
    seed=st.integers(0, 1 << 32),
    samples=st.one_of(st.integers(1, 130), st.sampled_from([999, 1000])),
    across=st.integers(2, 6),
    rest_across=st.integers(2, 4),
    taps=st.sampled_from([(8, 4), (6, 3), (1, 1), (16, 16)]),
    idle_word=st.sampled_from([0, 0x69969669, 0xFFFFFFFF]),
    of_band=st.sampled_from([(0, 0, 0), (2, 1769, -11973), (1, 16383, 7617), (256, -16383, -7617)]),
    points=st.lists(
        st.tuples(st.floats(0, 40e-3), st.floats(0, 40e-3), st.sampled_from([1.0, 1.0, 0.5, 0.2])), min_size=1, max_size=4
    ),
)
def test_the_compiled_kernel_gives_the_bits_of_its_twin(seed, samples, across, rest_across, taps, idle_word, of_band, points):
    found = []
    for composes, nulls in ((words_twin, null_twin), *zip(COMPILED, COMPILED, strict=True)):
        words, room, bank = buffers(seed, samples, across, rest_across, taps, idle_word, of_band)
        assert composes.compose(words, room, bank, points) == -1
        composed = bytes(words)
        assert nulls.null_places(words, room, bank, points, [(11e-3, 13e-3, 1.0)]) == -1
        found.append((composed, bytes(words)))
    assert all(words == found[0] for words in found)
    assert not ((np.frombuffer(b"".join(found[0]), "<u4") ^ idle_word) & 1 << 21).any(), "a channel without weights stays idle"


def test_a_response_is_the_sum_of_its_pulses():
    """In floats, with levels, scales and shares read by hand: what shifts drop is all that differs."""
    _, _, bank = buffers(3)
    twin = bank_twin.Responses(bank)
    tables, layer = twin.tables, twin.tables.in_band
    x_steps, y_steps = layer.steps + 1, layer.steps // 2
    x_m, y_m = 5e-3 + x_steps / layer.steps * PITCH_M, 6e-3 + y_steps / layer.steps * PITCH_M
    patch, _ = twin.patch(x_m, y_m)
    got = twin.turned(patch)[: twin.samples]
    half = (layer.across - 1) * layer.steps // 2
    total = np.zeros((layer.weights, 32))
    shares = []
    for y in range(4):
        for x in range(4):  # the place is between cells 1 and 2 along x, before 1 along y
            down, left = 2 * y_steps > 2 * half, 2 * x_steps > 2 * half
            row = min(y_steps, 2 * half - y_steps), min(x_steps, 2 * half - x_steps)
            entry = y * twin.nx + x
            (scale,) = np.frombuffer(bank.scales, np.float32, 1, 4 * entry)
            shares.append((entry, float(tables.stencil[row][3 - y if down else y, 3 - x if left else x]) * float(scale)))
    unit = compact_twin.SHARE_SUM / max(sum(abs(share) for _, share in shares), _rest_total(tables, x_m, y_m))
    for entry, share in shares:
        row = np.frombuffer(bank.response, np.uint8, twin.values, entry * twin.stride)
        for weight in range(layer.weights):
            for channel in range(32):
                lane, part = channel % 16 // 2, channel // 16 * 2 + channel % 2
                sixteen = int(row[16 * weight + 2 * lane]) | int(row[16 * weight + 2 * lane + 1]) << 8
                base, block = row[16 * layer.weights + 8 * part + lane], 16 * (weight // layer.block_rows) + 2 * lane
                scales = int.from_bytes(row[16 * layer.weights + 32 + block :][:2].tobytes(), "little")
                scale = base / 256 * ((scales >> 4 * part & 15) + 1) / 16
                total[weight, channel] += (2 * (sixteen >> 4 * part & 15) - 15) * share * unit * scale
    even = np.array([sum(total[int(p[0]) + tap] * p[1 + tap] / 32768 for tap in range(8)) for p in tables.pulses])
    turn = np.array([1 - 2 * (0x69969669 >> q & 1) for q in range(32)])
    assert np.abs(got[::2] - turn * even[: twin.samples // 2]).max() < 0.02 * np.abs(even).max()
    wrong = 1.05 * turn * even[: twin.samples // 2]
    assert np.abs(got[::2] - wrong).max() > 0.02 * np.abs(even).max()
    between = (even[5] + even[6]) * (0.5 + 2867 / 32768) - (even[4] + even[7]) * 3744 / 32768
    assert np.abs(got[11] - turn * between).max() < 0.02 * np.abs(even).max()
    assert abs((got[::2] - turn * even[: twin.samples // 2]).mean()) < 0.1, "what shifts drop is given back"
    assert np.array_equal(twin.equalised(patch)[: twin.samples], got), "faint as it is, it is not halved"


def _rest_total(tables, x_m, y_m):
    layer = tables.rest
    total = 0.0
    ix, right = compact_twin.along(x_m - tables.x0_m, tables.pitch_m, tables.rest_nx, layer)
    iy, up = compact_twin.along(y_m - tables.y0_m, tables.pitch_m, tables.rest_ny, layer)
    for (y, x), share in np.ndenumerate(compact_twin.shares(tables.rest_stencil, layer, right, up)):
        total += abs(float(share) * float(tables.rest_scales[(iy + y) * tables.rest_nx + ix + x]))
    return total


def test_numbers_are_packed_and_unpacked():
    numbers = np.random.default_rng(0).integers(0, 16, (9, 32)).astype(np.uint8)
    assert np.array_equal(compact_twin.unpacked(compact_twin.packed(numbers)), numbers)


OF_BAND_BEYOND = [(-1, 0, 0), (257, 0, 0), (2, 1 << 14, 0), (2, 0, -(1 << 14)), (2, -12001, 12000), (2, -(1 << 31), 0)]


@each_row("one", [words_twin, *COMPILED])
@each_row(
    "at, given",
    [
        *[(at, b"\xff" * 4) for at in (0, 4, 8, 12, 16, 20, 40, 44, 48, 52)],
        (56, np.float64(np.nan).tobytes()),
        *[(compact_twin.HEAD.size, compact_twin.OF_BAND.pack(*numbers)) for numbers in OF_BAND_BEYOND],
    ],
)
def test_tables_that_cannot_be_are_refused(one, at, given):
    words, room, bank = buffers(1)
    wrong = bytearray(bank.tables)
    wrong[at : at + len(given)] = given
    for tables in (bytes(wrong), bank.tables[:-64], bank.tables[:100]):
        with pytest.raises(ValueError, match="compact bank"):
            one.compose(words, room, bank._replace(tables=tables), [(9e-3, 9e-3, 1.0)])


def test_pulses_beyond_their_weights_are_refused():
    words, room, bank = buffers(1)
    tables, numbers = bytearray(bank.tables), compact_twin.HEAD.unpack_from(bank.tables)
    half = (numbers[0] - 1) * numbers[1] // 2 + 1
    at = compact_twin.TABLES_AT + -(-2 * half * half * numbers[0] ** 2 // 64) * 64
    for wrong, why in ((np.int16(numbers[2] - 7), "beyond its weights"), (np.int16(-1), "beyond its weights")):
        tables[at : at + 2] = wrong.tobytes()
        with pytest.raises(ValueError, match=why):
            compact_twin.CompactTables(tables, 96, 24)
    tables[at : at + 18] = np.array([0] + [2048] * 8, "<i2").tobytes()
    with pytest.raises(ValueError, match="taps"):
        compact_twin.CompactTables(tables, 96, 24)
    for compiled in COMPILED:  # it stays within its buffers all the same
        compiled.compose(words, room, bank._replace(tables=bytes(tables)), [(9e-3, 9e-3, 1.0)])


@each_row("one", [words_twin, *COMPILED])
def test_a_cell_that_may_not_be_used_yet_is_named(one):
    words, room, bank = buffers(2)
    bank.good[0] = 0
    assert one.compose(words, room, bank, [(5e-3, 6e-3, 1.0)]) == 0
    assert not any(words)


def test_shares_between_steps_are_linear():
    """Of a stencil whose shares are so themselves, up to its middle and mirrored beyond."""
    layer = compact_twin.PulseLayer(3, 4, 8, 8, 4)
    y, x, cell = np.mgrid[:5, :5, :9]
    stencil = (100 * y + 10 * x * y + 1000 * cell).astype(np.int16).reshape(5, 5, 3, 3)
    numbers = np.arange(9).reshape(3, 3)
    assert np.allclose(compact_twin.shares(stencil, layer, 1.25, 3.5), 350 + 43.75 + 1000 * numbers)
    assert np.allclose(compact_twin.shares(stencil, layer, 8 - 1.25, 3.5), 350 + 43.75 + 1000 * numbers[:, ::-1])
    assert np.allclose(compact_twin.shares(stencil, layer, 8, 8), 1000 * numbers[::-1, ::-1])
    for distance_m, first, beyond in ((-1.0, 0, 0.0), (2.3, 1, 5.2), (9.0, 3, 8.0), (np.nan, 0, 0.0)):
        assert compact_twin.along(distance_m, 1.0, 6, layer) == (first, pytest.approx(beyond))


def test_a_sketch_of_a_compact_bank_loses_no_bits():
    """Its weights are those of responses 16 times as strong; what lies beyond 11 bits is cut off, with either sign."""
    faint = np.random.default_rng(5).normal(0, 30, (3, 96, 32)).astype(np.int32)
    norms = [float(np.abs(response).sum()) for response in faint]
    found = polarity_twin.Sketch(faint, 3, faint=True).balanced(norms)
    assert found == polarity_twin.Sketch(16 * faint, 3, faint=False).balanced([16 * norm for norm in norms])
    assert found != pytest.approx(polarity_twin.Sketch(faint, 3, faint=False).balanced(norms), abs=0.01)
    strong, cut = (polarity_twin.Sketch(np.int32([[[-size]], [[size]]]), 1, faint=True)._gram for size in (20_000, 2047))
    assert strong.tolist() == cut.tolist()
