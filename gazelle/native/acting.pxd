# What acting.py says, for compiled modules.

cdef enum:
    BETWEEN = 0
    IN_STEP = 1
    AHEAD = 2
    OF_JOINTS = 3
    ADDRESS = 0
    ROWS = 1
    DIVISIBLE = 2
    LATE = 3
    LEAST = 4
    STEADY = 5
    ACTS = 6
    MERGEABLE = 7
    WIDTH = 8
