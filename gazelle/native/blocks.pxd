cdef extern from "threads.h":
    long long gazelle_fetch_add(long long *counter, long long amount) noexcept nogil


cdef long long next_block(long long[::1] taken) noexcept nogil
