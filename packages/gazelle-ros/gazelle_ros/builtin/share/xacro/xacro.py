#!/usr/bin/env python3
"""Expand a xacro file to standard output."""

import sys

from gazelle_ros.builtin.xacro import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
