"""`python -m controller`: the command line, for a release's environment, whose scripts are not used."""

import sys

from controller.cli import main

if __name__ == "__main__":
    sys.exit(main())
