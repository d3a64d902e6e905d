"""The program of a worker process: answers on its standard output what comes on its input."""

from __future__ import annotations

import os
import sys

from gazelle.training.workers.processes import serve


def main() -> None:
    """Keep the channel to ourselves: what anybody prints goes to the error output."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    serve(sys.stdin.buffer, answers)


if __name__ == "__main__":
    main()
