cdef void leave_slowly(size_t model, size_t data, size_t contact, int row) noexcept nogil
