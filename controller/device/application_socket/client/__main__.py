"""`python -m controller.device.application_socket.client`: the client on a command line."""

from __future__ import annotations

from controller.device.application_socket.client.command_line import main

if __name__ == "__main__":
    raise SystemExit(main())
