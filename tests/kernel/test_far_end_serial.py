"""The FPGA at the far end of a serial port has one clock: a frame may come just when somebody has looked at its outputs."""

from kernel import far_end_serial

from controller.device.service.drivers import gateware_hash


class SlowClock:
    """Each look at it takes some time."""

    def __init__(self, look_s):
        self.now_s, self.look_s = 0.0, look_s

    def __call__(self):
        self.now_s += self.look_s
        return self.now_s


def test_a_frame_that_comes_while_its_outputs_are_looked_at_is_answered(board, monkeypatch):
    clock = SlowClock(1e-3)
    monkeypatch.setattr(far_end_serial.time, "monotonic", clock)
    fpga = far_end_serial._Fpga(board, gateware_hash())
    clock.look_s = 0.0
    fpga.receive(b"\0")
    assert fpga.hv() is False
    assert fpga.receive(b"\x02\x01\0")
