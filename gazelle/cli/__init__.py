"""The command line: one command, ``gazelle``, with one module a sub-command."""
