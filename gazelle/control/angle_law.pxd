cdef double shortest(double start, double end) noexcept nogil
cdef double distance(double start, double end, bint continuous, double lower, double upper) noexcept nogil
