"""``python -m gazelle``: the command ``gazelle``."""

import sys

from gazelle.cli.main import main

sys.exit(main())
