"""Registers the corridors on import, for processes of workers."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
import corridor

corridor.register()
