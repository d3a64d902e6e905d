cimport cython

@cython.locals(single=float, known=float)
cdef void clean_all(
    const double[::1] ranges, float[::1] cleaned, double nearest, double farthest) noexcept
