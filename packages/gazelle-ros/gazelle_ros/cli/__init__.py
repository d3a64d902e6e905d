"""The command line ``gazelle-ros``; its commands are also those of ``gazelle``."""
