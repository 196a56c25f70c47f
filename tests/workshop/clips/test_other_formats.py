"""HJIF, .haps and vibration effects of Android: what is played when, and what is refused or reported as ignored."""

import copy
import json
from pathlib import Path

import pytest
from tables import each_row

from controller.cli import main
from controller.workshop.clips.android import read_android
from controller.workshop.clips.haps import read_haps
from controller.workshop.clips.hjif import read_hjif
from controller.workshop.clips.rhythm import rhythm_of

FILES = Path(__file__).parent / "files"
HJIF = json.loads((FILES / "own_two_clicks_and_swell.hjif").read_text())
HAPS = json.loads((FILES / "own_click_and_swell_v5.haps").read_text())
LEAST_MS = 2.0 / 0.3


def played(clip):
    return rhythm_of(clip, LEAST_MS, 50, 150)


def written(folder, name, content):
    file = folder / name
    file.write_text(content if isinstance(content, str) else json.dumps(content))
    return file


def test_two_clicks_and_a_swell_of_hjif():
    pulses, report = played(read_hjif(FILES / "own_two_clicks_and_swell.hjif"))
    assert pulses[:3] == [[0, 1], [125, 0.6], [300, 0.25]]
    # 100 Hz rising to 150 Hz in 300 ms: 37.5 turns
    assert (report.taps, report.taps_kept, report.wanted, report.kept, report.slowed, report.ignored) == (2, 2, 38, 38, 0, {})
    assert pulses[-1][0] == pytest.approx(300 + 296.7, abs=0.1), "turn 37 of 100 t + 83.3 t^2"
    assert pulses[-1][1] == pytest.approx(0.25 + 0.75 * 296.7 / 300, abs=0.01)


def test_the_same_clip_as_haps_has_the_same_swell():
    pulses, report = played(read_haps(FILES / "own_click_and_swell_v5.haps"))
    whole, _ = played(read_hjif(FILES / "own_two_clicks_and_swell.hjif"))
    assert pulses[0] == [0, 1]
    assert [[round(at_ms + 200, 3), level] for at_ms, level in pulses[1:]] == [
        pytest.approx(pulse, abs=1.1e-3) for pulse in whole[2:]
    ]
    assert report.ignored == {}


def hjif(change):
    changed = copy.deepcopy(HJIF)
    change(changed, changed["perceptions"][0], changed["perceptions"][0]["channels"][0])
    return changed


def test_ticks_gain_and_references_of_hjif(tmp_path):
    def change(whole, perception, channel):
        whole["timescale"] = 2000
        channel["gain"] = -0.5
        click = channel["bands"][0]["effects"][0] | {"id": 7}
        perception["effect_library"] = [click]
        channel["bands"] = [
            channel["bands"][0] | {"effects": [{"effect_type": "Reference", "id": 7, "position": at} for at in (0, 1000)]}
        ]

    clip = read_hjif(written(tmp_path, "a.hjif", hjif(change)))
    assert [(tap.at_s, tap.amplitude) for tap in clip.taps] == [(0, 0.5), (0.0625, 0.3), (0.5, 0.5), (0.5625, 0.3)]


def test_a_curve_of_hjif_is_felt_where_it_is_farthest_to_one_side(tmp_path):
    def change(whole, perception, channel):
        levels = [0.2, 0.4, 0.4, 0.8, 0.8, 0.3, 0.3, -1.0, 0.0, 0.5]
        points = [{"relative_position": 100 * n, "amplitude_modulation": level} for n, level in enumerate(levels)]
        channel["bands"] = [
            channel["bands"][1] | {"band_type": "Curve", "effects": [{"effect_type": "Basis", "keyframes": points}]}
        ]

    assert [(tap.at_s, tap.amplitude) for tap in read_hjif(written(tmp_path, "a.hjif", hjif(change))).taps] == [
        (0.3, 0.8),
        (0.9, 0.5),
    ]


def test_what_a_panel_has_no_counterpart_for_is_counted_by_name(tmp_path):
    def change(whole, perception, channel):
        whole["profile"] = "Main"
        band = channel["bands"][1]
        band["effects"] += [{"effect_type": "Composite", "position": 0}, band["effects"][0] | {"base_signal": "Square"}]
        channel["bands"].append(band | {"band_type": "WaveletWave", "block_length": 16})
        channel["actuator_target"] = [{"X": 0, "Y": 0}]
        whole["perceptions"].append(perception | {"perception_modality": "Stiffness"})

    assert read_hjif(written(tmp_path, "a.hjif", hjif(change))).ignored == {
        "Composite effect": 1,
        "WaveletWave": 1,
        "actuator_target": 1,
        "base_signal = Square": 1,
        "perception_modality = Stiffness": 1,
    }


def test_gains_and_mutes_of_haps(tmp_path):
    whole = copy.deepcopy(HAPS)
    whole["m_gain"] = 0.5
    whole["m_vibration"] |= {"m_gain": 0.8, "m_loop": 1}
    first, second = whole["m_vibration"]["m_melodies"]
    first["m_gain"] = 2.0
    first["m_notes"][0]["m_gain"] = 0.5
    second["m_mute"] = 1
    whole["m_stiffness"]["m_melodies"] = [{}]
    clip = read_haps(written(tmp_path, "a.haps", whole))
    assert [tap.amplitude for tap in clip.taps] == [pytest.approx(0.4)]
    assert clip.vibrations == ()
    assert clip.ignored == {"m_loop": 1, "melodies of stiffness": 1, "muted melody": 1}


def test_a_waveform_of_android_is_buzzes_at_its_times():
    clip = read_android(FILES / "own_double_buzz.xml")
    first, second, swell = clip.vibrations
    assert (first.start_s, first.end_s, second.start_s) == pytest.approx((0, 0.06, 0.16))
    assert second.amplitude.values == (128 / 255,)
    assert (swell.start_s, swell.end_s) == pytest.approx((0.22, 0.52))
    assert swell.amplitude.values == (0, 1, 0)
    assert swell.sharpness.values == (0.2, 0.8, 0.8)
    assert clip.ignored == {}


def test_what_android_repeats_is_played_once_and_names_are_counted(tmp_path):
    entry = '<waveform-entry durationMs="10" amplitude="default"/>'
    waveform = f"<waveform-effect>{entry}<repeating>{entry}</repeating></waveform-effect>"
    text = f'<vibration>{waveform}<primitive-effect name="spin"/></vibration>'
    clip = read_android(written(tmp_path, "a.xml", text))
    assert [(v.start_s, v.amplitude.values) for v in clip.vibrations] == [(0, (1.0,)), (0.01, (1.0,))]
    assert clip.ignored == {"repeating": 1, "primitive-effect spin": 1}


def entry(**values):
    inside = " ".join(f'{name}="{value}"' for name, value in values.items())
    return f"<vibration-effect><waveform-effect><waveform-entry {inside}/></waveform-effect></vibration-effect>"


def library_of(count):
    def change(whole, perception, channel):
        points = [{"relative_position": n} for n in range(count)]
        perception["effect_library"] = [{"effect_type": "Basis", "id": 7, "position": 0, "keyframes": points}]
        channel["bands"][0]["effects"] = [{"effect_type": "Reference", "id": 7, "position": 0}] * count

    return change


def reference_to_nothing(whole, perception, channel):
    channel["bands"][0]["effects"] = [{"effect_type": "Reference", "id": 3}]


@each_row(
    ("name", "content", "said"),
    [
        ("a.hmpg", "", "is the binary form of HJIF: save it as .hjif"),
        ("a.hjif", HJIF | {"version": "2019"}, "version = '2019': a year from 2023 on"),
        ("a.hjif", HJIF | {"profile": "Other"}, "Invalid enum value 'Other' - at `$.profile`"),
        ("a.hjif", HJIF | {"timescale": 0}, "`$.timescale`"),
        ("a.hjif", hjif(reference_to_nothing),
         "perceptions[0].effect_library has no effect 3"),
        ("a.hjif", hjif(library_of(1001)), "more than 1,000,000 keyframes"),
        ("a.haps", HAPS | {"m_version": "4"}, "its version is '4': only 5"),
        ("a.haps", {"version": "6", "vibration": {}}, "its version is '6': only 5"),
        ("a.haps", {"m_version": "5"}, "missing required field `m_vibration`"),
        ("a.xml", "<a/>", "is <a>: only <vibration-effect> is known"),
        ("a.xml", "<vibration-effect>", "no element found"),
        ("a.xml", '<!DOCTYPE a [<!ENTITY b "bbbb">]><vibration-effect>&b;</vibration-effect>', "has a DOCTYPE"),
        ("a.xml", entry(amplitude=3), "a waveform-entry has no durationMs"),
        ("a.xml", entry(durationMs="nan", amplitude=3), "durationMs = 'nan' of a waveform-entry: a number from 0 to"),
        ("a.xml", entry(durationMs=5, amplitude=256), "amplitude = '256' of a waveform-entry: a number from 0 to 255"),
        ("a.xml", "<vibration-effect><basic-envelope-effect/></vibration-effect>", "nothing of it is felt"),
    ],
)  # fmt: skip
def test_what_cannot_be_meant_is_refused_in_one_line(name, content, said, tmp_path, capsys):
    assert main(["effect", "import", str(written(tmp_path, name, content))]) == 78
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"haptic-panel: {tmp_path / name}: ")
    assert said in err
    assert err.count("\n") == 1
