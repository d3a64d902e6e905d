# The same numbers as in columns.py, known when kernels are compiled.

cdef enum:
    DIRECTIONAL = 0
    POINT = 1
    SPOT = 2

    KIND = 0
    ALONG = 4
    COLOR = 7
    REACH = 10
    CONSTANT = 11
    LINEAR = 12
    QUADRATIC = 13
    INNER = 14
    OUTER = 15
    LAMP = 16

    UNSEEN = 13
    CAMERA = 14

    FIRST_VERTEX = 0
    LAST_VERTEX = 1
    FIRST_FACE = 2
    LAST_FACE = 3
    TWO_SIDED = 4
    MESH = 5

    MESH_OF_PART = 0
    LINK_OF_PART = 1
    LABEL_OF_PART = 2
    TEXTURE_OF_PART = 3
    PART = 4

    FIRST_TEXEL = 0
    TEXTURE_WIDTH = 1
    TEXTURE_HEIGHT = 2
    TEXTURE = 3
