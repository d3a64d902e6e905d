# What law_data_indices.py says, for compiled modules.

cdef enum:
    HEAD = 11
    WORLD = 10
    COM_VEL = 0
    RNE = 1
    SOLVE_M = 2
    COUNT = 3
    HINGES = 4
    BIAS_HEAD = 5
    GEOM_NUMBERS = 9
    NO_DIRECTION = 0
    ITS_OWN = 1
    BY_THE_NORMAL = 2
    TREAD = 5
    MIDDLE = 6
    EXIT = 7
    ALIKE = 8

cdef extern from *:
    """
    #define GAZELLE_MARK 7.0131e57
    """
    const double MARK "GAZELLE_MARK"
