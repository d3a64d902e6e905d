cdef void take_commands(size_t data, size_t hooks, Py_ssize_t world) noexcept nogil
