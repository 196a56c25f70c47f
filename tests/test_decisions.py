"""The records in controller/decisions: one form, and an index that says the same."""

import re
from pathlib import Path

FOLDER = Path(__file__).parent.parent / "controller" / "decisions"
HEADINGS = ["Context", "Decision", "Because", "Considered", "Consequences"]


def test_every_record_has_the_same_form_and_its_row_in_the_index():
    rows = []
    for number, path in enumerate(sorted(FOLDER.glob("[0-9]*.md")), 1):
        text = path.read_text()
        head = re.match(r"# (\d+)\. (.+)\n\n(\d{4}-\d\d-\d\d), (accepted|superseded by \d+)\n", text)
        assert head, path
        assert path.name.startswith(f"{number:04d}-"), path
        assert int(head[1]) == number, path
        assert re.findall(r"^## (.+)$", text, re.MULTILINE) == HEADINGS, path
        rows.append(f"| [{number}]({path.name}) | {head[2]} | {head[3]} | {head[4]} |")
    assert re.findall(r"^\| \[\d.*$", (FOLDER / "README.md").read_text(), re.MULTILINE) == rows
