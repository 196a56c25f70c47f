"""What the tests of updates share: an HTTP server on this machine whose answers a test may change."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))  # where the tests find `scripted_server` and `repository_fixture`

from scripted_server import ScriptedServer


@pytest.fixture
def serve():
    """Serves a folder; what it was asked for is in `requests`."""
    servers = []

    def begin(folder, tls=None):
        servers.append(ScriptedServer(folder, tls))
        return servers[-1]

    yield begin
    for server in servers:
        server.stop()
