cimport cython

@cython.locals(product=double, whole=double, ties=Py_ssize_t)
cdef void round_all(const double[::1] x, double[::1] found, double scale) noexcept
@cython.locals(product=double, whole=double)
cdef double round_one(double x, double scale) noexcept nogil
@cython.locals(high=double, error=double, below=double)
cdef double settled(double x, double product, double scale) noexcept nogil
