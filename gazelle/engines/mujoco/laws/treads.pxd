cdef void stand_in_the_middle(size_t model, size_t data, size_t contact, int row, double sparse) noexcept nogil
