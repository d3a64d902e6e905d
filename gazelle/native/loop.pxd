cdef extern from "threads.h":
    void gazelle_wait_for_all(long long *places, long long threads) noexcept nogil


cdef enum:
    APART = 16  # so many numbers apart, threads do not fight for a line of a cache


cdef class SystemLoop:
    cdef readonly list systems
    cdef readonly Py_ssize_t nworld
    cdef public long long step
    cdef public long long time
    cdef object _pool
    cdef long long[:, ::1] _table
    cdef double[::1] _rates
    cdef long long[:, ::1] _due
    cdef long long[::1] _shared
    cdef long long[::1] _end
    cdef void _play_worlds(self, Py_ssize_t part, Py_ssize_t blocks, long long until) noexcept nogil
    cdef void _play_together(self, Py_ssize_t part, Py_ssize_t threads, long long until) noexcept nogil
    cdef void _wait_for_all(self, Py_ssize_t threads) noexcept nogil
    cdef object _update_due(self, Py_ssize_t row, long long late)
    cdef long long _steps_to_due(self, Py_ssize_t row, long long until) noexcept nogil
    cdef void _pass_within(self, Py_ssize_t row) noexcept nogil
    cdef void _pass(self, Py_ssize_t row, long long until) noexcept nogil
    cdef long long _moment_of(self, Py_ssize_t index, long long time) noexcept nogil
    cdef void _begin(self, Py_ssize_t part) noexcept nogil
    cdef long long _make_steps(
        self, Py_ssize_t part, Py_ssize_t first, Py_ssize_t last, long long time, long long until
    ) noexcept nogil
    cdef long long _steps_alike(
        self, Py_ssize_t part, Py_ssize_t index, long long time, long long until) noexcept nogil
    cdef bint _is_due(self, Py_ssize_t part, Py_ssize_t index, long long time) noexcept nogil
    cdef void _update(
        self, Py_ssize_t index, Py_ssize_t first, Py_ssize_t last, long long time, long long count
    ) noexcept nogil
