"""The program of a worker process, which answers requests on standard input."""

from __future__ import annotations

import os
import sys
import traceback

from gazelle.training.workers.processes import serve


def main() -> None:
    """Serve on the original standard output; all other output goes to standard error."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    code = 0
    try:
        serve(sys.stdin.buffer, answers)
    except BaseException:  # noqa: BLE001  # as Python does, but for what follows
        traceback.print_exc()
        code = 1
    sys.stderr.flush()
    os._exit(code)  # the thread that reads the requests would abort the end of the interpreter


if __name__ == "__main__":
    main()
