"""``python -m gazelle_ros``: the command ``gazelle-ros``."""

import sys

from gazelle_ros.cli.main import main

sys.exit(main())
