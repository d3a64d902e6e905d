cimport cython

cdef enum:
    WIDE = 32

@cython.locals(single=float, known=float)
cdef void clean_all(
    const double[:, ::1] ranges, float[:, ::1] cleaned, double nearest, double farthest) noexcept

cdef void find_nearest(const float[:, ::1] ranges, Py_ssize_t[::1] ray) noexcept

@cython.locals(best=float, at=Py_ssize_t, closer=int, nearer=bint, j=Py_ssize_t, k=Py_ssize_t)
cdef Py_ssize_t nearest_of(const float[:, ::1] ranges, Py_ssize_t i, Py_ssize_t samples) noexcept nogil
