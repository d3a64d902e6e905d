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
    @cython.locals(rate=double, whole=double, term=double, out=double)
    cdef double push(self, Py_ssize_t world, Py_ssize_t loop, double error, double dt, bint rated, double given) noexcept nogil
    @cython.locals(k=Py_ssize_t, count=Py_ssize_t, own="double*", known="double*")
    cdef void push_row(self, Py_ssize_t world, double* errors, double dt, bint near, bint rated, double* rates, double* out) noexcept nogil
    @cython.locals(w=Py_ssize_t, first=Py_ssize_t, rated=bint, errors="double[:, ::1]", rates="double[:, ::1]", out="double[:, ::1]", period=double)
    cpdef compute(self, error, double dt, rate, into)

@cython.locals(k=Py_ssize_t, odd=Py_ssize_t)
cdef bint are_finite(Py_ssize_t count, double* values) noexcept nogil

@cython.locals(k=Py_ssize_t)
cdef void differentiate(Py_ssize_t count, double dt, double* restrict errors, double* restrict last, double* restrict rates) noexcept nogil

@cython.locals(k=Py_ssize_t, whole=double, term=double)
cdef void push_loops(Py_ssize_t count, double dt, double* restrict errors, double* restrict rates, double* restrict p_error, double* restrict i_error, double* restrict output, double* restrict out, double* restrict p, double* restrict i, double* restrict d, double* restrict sum_least, double* restrict sum_most, double* restrict term_least, double* restrict term_most) noexcept nogil
