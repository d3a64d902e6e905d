from __future__ import annotations

import pytest

from gazelle.cli.main import main


@pytest.fixture
def cli(capsys):
    """Runs the command line; gives the exit code, what it said, and what it complained."""

    def run(*arguments):
        code = main([str(argument) for argument in arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run
