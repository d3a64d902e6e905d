"""The program ``nodelet``: several built-in nodes in one process."""
