cdef void hold_loosely(size_t model, size_t data, size_t contact, int row) noexcept nogil
