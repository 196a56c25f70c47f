"""Fixtures: the gateware model with a host at its pins (model_host.py)."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # where the tests find model_host

from model_host import Host


@pytest.fixture
def host():
    """A model just reset, with its permits given."""
    return Host()


@pytest.fixture
def armed():
    """Armed and idle, with WORDS in slot 0."""
    host = Host().arm()
    host.store(0)
    host.pins_after(0)
    return host
