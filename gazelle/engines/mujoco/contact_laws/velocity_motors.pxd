cdef void drive_motors(size_t model, size_t data, int count) noexcept nogil
