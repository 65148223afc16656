"""``python -m skyline_viz`` is ``skyline-viz``."""

import sys

from skyline_viz.cli import main

if __name__ == "__main__":
    sys.exit(main())
