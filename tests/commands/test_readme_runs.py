"""`haptic-panel run` as the READMEs show it; all else that they show is run by test_project.py, which another process may have."""

import pytest
from readme_commands import works


@pytest.mark.kernel
def test_every_run_of_every_readme_works(tmp_path, state_folder):
    said = works(tmp_path, state_folder / "gateware", "sh", "run")
    assert "$ .venv/bin/haptic-panel run --scene library" in said
