"""Print what the last run of the tests skipped, a line each, for ``pytest @FILE``."""

import json
from pathlib import Path

found = Path(".pytest_cache/v/gazelle/skipped")
for name in dict.fromkeys(json.loads(found.read_text())):
    print(name)  # noqa: T201
