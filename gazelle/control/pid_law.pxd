cimport cython

cdef enum:
    LAST = 0
    P_ERROR = 1
    I_ERROR = 2
    D_ERROR = 3
    OUTPUT = 4
    ROWS = 5

@cython.final
cdef class PidLaw:
    cdef double[:, :, ::1] memory
    cdef double[::1] p, i, d, sum_least, sum_most, term_least, term_most
    cdef Py_ssize_t count
    cdef double *memory_at
    cdef double *p_at, *i_at, *d_at, *sum_least_at, *sum_most_at, *term_least_at, *term_most_at
    @cython.locals(rate=double, whole=double, out=double)
    cdef double push(self, Py_ssize_t world, Py_ssize_t loop, double error, double dt, bint rated, double given) noexcept nogil
    @cython.locals(w=Py_ssize_t, k=Py_ssize_t, rated=bint, errors="double[:, ::1]", rates="double[:, ::1]", out="double[:, ::1]", period=double)
    cpdef compute(self, error, double dt, rate, into)
