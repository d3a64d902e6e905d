cdef double sin(double x) noexcept nogil
cdef double cos(double x) noexcept nogil
cdef double atan2(double y, double x) noexcept nogil
cdef double log(double x) noexcept nogil
