cdef class System:
    cdef readonly Py_ssize_t rows
    cdef public double rate
    cdef public bint late, steady, mergeable
    cdef public Py_ssize_t least
    cdef readonly bint divisible
    cdef public long long due
    cdef public object uses
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    cdef void update_steps(
        self, Py_ssize_t first, Py_ssize_t last, long long time, Py_ssize_t count) noexcept nogil
