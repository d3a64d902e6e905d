cdef void stay_down(size_t model, size_t data, size_t contact, int row, double sparse) noexcept nogil
