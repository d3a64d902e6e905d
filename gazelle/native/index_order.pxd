cimport cython

@cython.locals(i=Py_ssize_t, index=Py_ssize_t)
cpdef int order_of(const Py_ssize_t[:] indices, Py_ssize_t count) noexcept
