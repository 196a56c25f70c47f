"""What `-m quick` leaves out, and does not even import: what compiles, simulates, starts services or builds banks, for seconds."""

from pathlib import Path

HERE = Path(__file__).parent
SLOWER = [
    "board_top/",
    "conformance/",
    "kernel/",
    "rtl/",
    "stress/",
    "commands/test_calibrate_channels.py",
    "commands/test_calibrate_measures.py",
    "commands/test_calibrate_walk.py",
    "commands/test_cli.py",
    "commands/test_gateware.py",
    "commands/test_nobody.py",
    "commands/test_readme_runs.py",
    "test_build.py",
    "test_clocks.py",
    "test_console.py",
    "test_patience.py",
    "test_project.py",
    "test_wings.py",
    "device/application_socket/test_try_it.py",
    "device/bank/test_inspection.py",
    "device/board/test_boards.py",
    "device/doctor/test_bring_up.py",
    "device/doctor/test_doctor.py",
    "device/fpga/test_supervision.py",
    "device/kernel/test_aarch64.py",
    "device/loop/test_allocations.py",
    "device/loop/test_listening.py",
    "device/loop/test_outputs.py",
    "device/loop/test_prefetch.py",
    "device/loop/test_random_play.py",
    "device/loop/test_schedule.py",
    "device/page/test_bridge.py",
    "device/page/test_tools.py",
    "device/scene/test_coverage.py",
    "device/service/test_layer_preparer.py",
    "device/service/test_run.py",
    "device/service/test_scene_reload.py",
    "device/touch/test_prediction.py",
    "device/touch_calibration/test_lag_figures.py",
    "device/touch_calibration/test_running.py",
    "device/update/power_cut/",
    "device/update/test_fall_back.py",
    "device/update/test_install.py",
    "workshop/bank_builder/",
    "workshop/benchmark/",
    "workshop/calibration/test_calibrate_check.py",
    "workshop/calibration/test_interpolate.py",
    "workshop/calibration/test_learning.py",
    "workshop/calibration/test_simulated_measurement.py",
    "workshop/clips/test_mutated_files.py",
    "workshop/physics/test_impulse_response.py",
    "workshop/physics/test_ritz.py",
    "workshop/publish/test_make_release.py",
    "workshop/simulation/",
]
SECONDS = {  # tests of other files that take longest
    "test_a_calibrated_bank_focuses_where_the_models_own_does_not",
    "test_a_decoder_sees_exactly_the_contacts_of_each_report",
    "test_a_hundred_thousand_events_and_controls_take_seconds",
    "test_a_planted_file_of_a_release_never_runs_as_root_whatever_is_called",
    "test_any_sequence_of_failures_is_recovered",
    "test_audible_energy_adds_up_to_the_energy_over_time",
    "test_each_shipped_clip_comes_back_from_either_file",
    "test_every_tick_is_as_in_the_reference",
    "test_pulses_come_back_from_either_file_and_from_one_by_way_of_the_other",
    "test_whatever_is_sent_each_region_is_taken_or_refused",
}


def is_quick(path):
    """Whether `-m quick` runs tests of a file."""
    name = path.relative_to(HERE).as_posix()
    return not any(name == one or (one[-1] == "/" and name.startswith(one)) for one in SLOWER)
