# The same numbers as in scan_columns.py, known when kernels are compiled.

cdef enum:
    MOST_LANES = 64
    LANE_X = 0
    LANE_Y = 64
    LANE_DX = 128
    LANE_DY = 192
    LANE_U = 256
    LANE_V = 320
    LANE_DU = 384
    LANE_DV = 448
    LANE_OVER_U = 512
    LANE_OVER_V = 576
    LANE_AT = 640
    LANE_END = 704
    LANE_OUT = 768
    LANE_BEST = 832
    LANE_NAME = 896
    LANE_HEIGHT = 960
    LANE_AT_U = 1024
    LANE_AT_V = 1088
    LANE_FREE = 1152
    LANE_BASE = 1216

    CORNER_U = 0
    CORNER_V = 1
    SIDE_U = 2
    SIDE_V = 3
    COLUMNS = 4
    ROWS = 5
    TURN_COS = 6
    TURN_SIN = 7
    SOLID_LOW = 8
    SOLID_HIGH = 9
    SOLID_NAME = 10

    ROOM = 256
    C_X0 = 0
    C_Y0 = 256
    C_X1 = 512
    C_Y1 = 768
    C_RADIUS = 1024
    C_FIRST = 1280
    C_SPAN = 1536
    C_NAME = 1792
    C_INVERSE = 2048
    C_COS = 2304
    C_SIN = 2560

    F_AX = 0
    F_AY = 256
    F_BX = 512
    F_BY = 768
    F_OPEN = 1024
    F_LOW = 1280
    F_HIGH = 1536
    F_X0 = 1792
    F_Y0 = 2048
    F_X1 = 2304
    F_Y1 = 2560
    F_INVERSE = 2816
    F_TURNS = 3072

    ALL = 0
    CROWDED = 1
    SINGLY = 2
    ANGLE_NOISE = 3
