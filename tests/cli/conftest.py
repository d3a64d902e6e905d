from __future__ import annotations

import pytest

from gazelle.cli.main import main


@pytest.fixture
def cli(capsys):
    """Return a runner of the command line, which returns exit code, output and errors."""

    def run(*arguments):
        code = main([str(argument) for argument in arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run
