"""The command line ``gazelle-ros``, whose commands are also those of ``gazelle``."""
