"""Leaf modules that import nothing but each other: errors, files, processes, signals."""
