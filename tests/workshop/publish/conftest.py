"""What publishes is held against the device that fetches it: small releases and devices are those of its tests."""

import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[2] / "device" / "update")]
