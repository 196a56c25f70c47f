"""A model of the gateware with a host on its pins; the class itself is in model_host.py."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # where the tests find model_host

from model_host import Host


@pytest.fixture
def host():
    """A model just out of reset, with its permits given."""
    return Host()


@pytest.fixture
def armed():
    """Armed, with WORDS in slot 0 and nothing else going on."""
    host = Host().arm()
    host.store(0)
    host.pins_after(0)
    return host
