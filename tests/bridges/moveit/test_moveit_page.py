"""The script of docs/reference/moveit.md, as ``gazelle exec`` runs it."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from bridges.moveit.commander_graph import commander_graph

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "moveit.md"


@pytest.mark.long
def test_the_script_of_the_page_runs(tmp_path):
    (script,) = re.findall(
        r"^```text\n(import sys.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE
    )
    file = tmp_path / "demo.py"
    file.write_text(script)
    with commander_graph() as (client, _):
        ran = subprocess.run(
            [sys.executable, "-m", "gazelle", "exec", str(file)],
            env=os.environ | {"ROS_MASTER_URI": client.node.master_uri},
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        assert ran.returncode == 0, ran.stderr
        assert "fraction 1.0" in ran.stdout
