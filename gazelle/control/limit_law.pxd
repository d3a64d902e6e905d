cimport cython

@cython.final
cdef class LimitLaw:
    cdef double[::1] lower, upper, velocity, acceleration, effort, k_position, k_velocity, soft_lower, soft_upper
    cdef unsigned char[::1] soft, bounded
    cdef readonly bint hard
    cdef Py_ssize_t count
    cdef double *lower_at, *upper_at, *velocity_at, *effort_at
    cdef double soft_bound(self, Py_ssize_t i, double position, bint high) noexcept nogil
    @cython.locals(low=double, high=double, least=double, most=double)
    cdef double hold_effort(self, Py_ssize_t i, double command, double position, double velocity) noexcept nogil
    @cython.locals(low=double, high=double)
    cdef double hold_position(self, Py_ssize_t i, double command, double before, double dt) noexcept nogil
    @cython.locals(low=double, high=double, change=double, start=double)
    cdef double hold_velocity(self, Py_ssize_t i, double command, double position, double velocity, double before, double dt) noexcept nogil
    @cython.locals(w=Py_ssize_t, i=Py_ssize_t, a="const double[:, :]", b="const double[:, :]", c="const double[:, :]", out="double[:, ::1]")
    cpdef hold_efforts(self, command, position, velocity)
    @cython.locals(w=Py_ssize_t, i=Py_ssize_t, a="const double[:, :]", b="const double[:, :]", period=double, out="double[:, ::1]")
    cpdef hold_positions(self, command, position, previous, double dt)
    @cython.locals(w=Py_ssize_t, i=Py_ssize_t, a="const double[:, :]", b="const double[:, :]", c="const double[:, :]", period=double, out="double[:, ::1]")
    cpdef hold_velocities(self, command, position, velocity, previous, double dt)

cdef double clamp(double value, double low, double high) noexcept nogil
