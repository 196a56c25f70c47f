"""Fixed emitters: what the FPGA can repeat by itself."""

from controller.device.loop.fixed_emitters import common_period_s
from controller.device.scene.scene import FixedEmitter


def test_only_spots_that_share_a_waveform_have_a_common_period():
    emitter = FixedEmitter(0.06, 0.07, 20.0, "a")
    far = emitter._replace(x_m=0.1, region="b")
    assert (
        common_period_s([emitter]) == common_period_s([emitter, far]) == common_period_s([emitter._replace(alternate=True)]) == 0.05
    )
    assert common_period_s([]) is None
    for changed in ({"rate_hz": 20.2}, {"phase": 0.5}, {"alternate": True}, {"x_m": 0.063, "amplitude": 0.5}):
        assert common_period_s([emitter, far._replace(**changed)]) is None, changed
