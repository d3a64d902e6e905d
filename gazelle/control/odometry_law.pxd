cdef class OdometryLaw:
    cdef double[:, ::1] pose, twist
    cdef double[:, :, ::1] recent
    cdef long long[::1] kept, place
    cdef void move(self, Py_ssize_t world, double forward, double sideways, double turned) noexcept nogil
    cdef void advance(self, Py_ssize_t world, double forward, double sideways, double turned, double dt) noexcept nogil
    cdef void drive(self, Py_ssize_t world, double forward, double sideways, double turning, double dt) noexcept nogil
