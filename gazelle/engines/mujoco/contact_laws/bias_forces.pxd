cdef double MOST_A_STEP

cdef bint take_bias_midway(size_t model, size_t data, size_t numbers, size_t told) noexcept nogil
