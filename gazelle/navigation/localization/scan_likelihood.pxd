# What scan_likelihood.py says, for compiled modules.

cdef enum:
    LANES = 32
