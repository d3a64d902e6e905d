cdef unsigned long long mixed(unsigned long long value) noexcept nogil
cdef unsigned long long stream(long long seed, long long body, long long tick) noexcept nogil
cdef double uniform(unsigned long long start, unsigned long long place) noexcept nogil
cdef double normal(unsigned long long start, unsigned long long place) noexcept nogil
