cimport cython

@cython.final
cdef class PidLaw:
    cdef double[:, ::1] last, p_error, i_error, d_error, output
    cdef double[::1] p, i, d, sum_least, sum_most, term_least, term_most
    @cython.locals(rate=double, whole=double, term=double, out=double)
    cdef double push(self, Py_ssize_t world, Py_ssize_t loop, double error, double dt, bint rated, double given) noexcept nogil
    @cython.locals(w=Py_ssize_t, k=Py_ssize_t, rated=bint, errors="const double[:, :]", rates="const double[:, :]", out="double[:, ::1]", period=double)
    cpdef compute(self, error, double dt, rate, into)
