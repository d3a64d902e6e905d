"""Command lines with a wrong word end well, see ``wrong_words``; ``tools/wrong_lines.py`` tries all."""

import subprocess
import sys
from pathlib import Path

import pytest
from cli import wrong_words

from gazelle.cli.commands import COMMANDS

TOOL = Path(__file__).parents[2] / "tools" / "wrong_lines.py"


def test_there_are_lines_for_every_command():
    lines = list(wrong_words.command_lines([]))
    tried = {line.words[0] for line in lines}
    assert not set(COMMANDS) - tried - wrong_words.LEFT_OUT
    assert len(lines) > 5_000


@pytest.mark.slow
@pytest.mark.parametrize("commands", ["check convert map plot tasks bag msg param", "demo train"])
def test_wrong_lines_end_well(commands):
    words = [sys.executable, str(TOOL), *commands.split(), "--every", "41"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
