cdef long long moment(long long count, double rate) noexcept nogil
cdef long long next_due(long long time, double rate) noexcept nogil
