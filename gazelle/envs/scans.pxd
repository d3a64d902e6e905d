cimport cython

@cython.locals(single=float, known=float)
cdef void clean_all(
    const double[:, ::1] ranges, float[:, ::1] cleaned, double nearest, double farthest) noexcept

@cython.locals(best=float, at=Py_ssize_t, closer=bint)
cdef void find_nearest(const float[:, ::1] ranges, float[::1] shortest, Py_ssize_t[::1] ray) noexcept
