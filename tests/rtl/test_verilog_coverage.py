"""The reader of coverage.dat, on a file written by hand; what it says of the real benches is in test_rtl.py."""

import pytest
from tables import each_row
from verilog_coverage import lcov, line_counts, load_waivers, read, readable, table, together, too_little, uncovered, waive

SOURCE = """\
module blink (input wire clk_i, input wire fast_i, output reg led_o);
    always @(posedge clk_i) begin
        led_o <= fast_i ? !led_o : led_o;
        if (fast_i)
            led_o <= 1'b0;
        else
            led_o <= 1'b1;
    end
endmodule
"""


def point(page, line, column, what, count, stands_for="", instance="top.blink", module="blink"):
    keys = {
        "f": "/elsewhere/blink.v",
        "l": line,
        "n": column,
        "page": f"v_{page}/{module}",
        "o": what,
        "S": stands_for,
        "h": instance,
    }
    return "C '" + "".join(f"\x01{key}\x02{value}" for key, value in keys.items() if value != "") + f"' {count}\n"


def dat(*, then=3, other=0, first=10, **place):
    return "# SystemC::Coverage-3\n" + "".join(
        [
            point("line", 2, 5, "block", first, "2-3,8", **place),
            point("branch", 3, 25, "cond_then", then, "3", **place),
            point("branch", 3, 26, "cond_else", other, "3", **place),
            point("branch", 4, 9, "if", then, "4-5", **place),
            point("branch", 4, 10, "else", other, "7", **place),
            point("toggle", 1, 30, "fast_i:0->1", then, **place),
            point("toggle", 1, 30, "fast_i:1->0", other, **place),
        ]
    )


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "blink.v").write_text(SOURCE)
    return tmp_path


def write(folder, name, text):
    (folder / name).write_text(text)
    return folder / name


def test_a_line_counts_what_of_it_happened_least(folder):
    counts = line_counts(read(write(folder, "a.dat", dat())))
    assert counts == {"blink.v": {2: 10, 3: 0, 4: 3, 5: 3, 7: 0, 8: 10}}
    assert uncovered(counts, folder) == ["blink.v:3: led_o <= fast_i ? !led_o : led_o;", "blink.v:7: led_o <= 1'b1;"]


def test_runs_instances_and_parameters_add_up(folder):
    runs = [
        write(folder, "a.dat", dat()),
        write(folder, "b.dat", dat(then=0, other=2, instance="blink", module="blink__W2")),
    ]
    counts = line_counts(read(*runs))
    assert counts == {"blink.v": {2: 20, 3: 2, 4: 3, 5: 3, 7: 2, 8: 20}}
    assert line_counts(together(read(run) for run in runs)) == counts


def test_what_happened_in_no_run_is_not_forgotten(folder):
    run = read(write(folder, "a.dat", dat()))
    assert line_counts(together([run, run]))["blink.v"][7] == 0
    assert len(together([run, run])) == len(run) == 7


def test_the_table_and_the_gate(folder):
    hits = read(write(folder, "a.dat", dat()))
    rows = table(hits, line_counts(hits), ["blink"])
    assert rows == [("blink", 4, 6, 2, 4, 1, 2), ("all", 4, 6, 2, 4, 1, 2)]
    assert readable(rows)[1].split() == ["blink", "4/6", "66.7", "%", "2/4", "50.0", "%", "1/2", "50.0", "%"]
    assert too_little(rows) == ["blink", "all"]
    assert too_little([("a", 95, 100, 0, 0, 0, 0), ("b", 94, 100, 0, 0, 0, 0)]) == ["b"]


def test_a_module_of_no_bench_is_too_little(folder):
    hits = read(write(folder, "a.dat", dat(other=1)))
    rows = table(hits, line_counts(hits), ["blink", "forgotten"])
    assert too_little(rows) == ["forgotten"]
    assert too_little([("wires", 0, 0, 0, 0, 3, 90), ("nowhere", 0, 0, 0, 0, 0, 0)]) == ["nowhere"]
    assert readable(rows)[2].split()[:4] == ["forgotten", "0/0", "0.0", "%"]


def test_waivers_take_lines_without_cover_away(folder):
    counts = line_counts(read(write(folder, "a.dat", dat())))
    waivers = [
        {"file": "blink.v", "pattern": r"led_o <= 1'b1", "reason": "never slow"},
        {"file": "blink.v", "line": 3, "reason": "by number"},
    ]
    left, wrong = waive(counts, waivers, folder)
    assert (left, wrong) == ({"blink.v": {2: 10, 4: 3, 5: 3, 8: 10}}, [])
    assert 3 in counts["blink.v"]  # what was given stays as it was


@each_row(
    ("waiver", "what"),
    [
        ({"file": "blink.v", "pattern": "no such text", "reason": "x"}, "waives nothing"),
        ({"file": "blink.v", "pattern": "1'b0", "reason": "x"}, "waives nothing"),
        ({"file": "blink.v", "line": 6, "reason": "x"}, "waives nothing"),
        ({"file": "gone.v", "line": 3, "reason": "x"}, "waives nothing"),
        ({"file": "blink.v", "line": 3, "reason": ""}, "no reason"),
    ],
    afresh=[folder],
)
def test_a_waiver_is_needed_and_has_a_reason(folder, waiver, what):
    counts = line_counts(read(write(folder, "a.dat", dat())))
    _, (said,) = waive(counts, [waiver], folder)
    assert what in said
    assert waiver["file"] in said


def test_lcov_names_every_line(folder):
    assert lcov(line_counts(read(write(folder, "a.dat", dat()))), folder).splitlines() == [
        f"SF:{folder / 'blink.v'}",
        *("DA:2,10", "DA:3,0", "DA:4,3", "DA:5,3", "DA:7,0", "DA:8,10"),
        "end_of_record",
    ]


def test_waivers_are_read_from_a_file(tmp_path):
    text = '[[waiver]]\nfile = "blink.v"\nline = 3\nreason = "x"\n'
    assert load_waivers(write(tmp_path, "waivers.toml", text)) == [{"file": "blink.v", "line": 3, "reason": "x"}]
    assert isinstance(load_waivers(), list)
