# The same numbers as in picture_columns.py, known when kernels are compiled.

cdef enum:
    RED = 12
    OWNER = 15
    FACE = 16

    RIGHT = 3
    DOWN = 6
    AHEAD = 9
    CARRIER = 12
    UNSEEN = 13
    CAMERA = 14

    FX = 0
    FY = 1
    NEAREST = 2
    FARTHEST = 3
    LENS = 4
