from gazelle.control.control_law cimport ControlLaw
from gazelle.control.odometry_law cimport OdometryLaw

cdef class BaseLaw(ControlLaw):
    cdef OdometryLaw odometry
    cdef double[:, ::1] desired, last, earlier, bounds
    cdef long long[::1] stamps
    cdef unsigned char[::1] lost
    cdef long long timeout
    cdef bint open_loop
    cdef void control(self, Py_ssize_t world, long long now, double period) noexcept nogil
    cdef bint advance(self, Py_ssize_t world, double period) noexcept nogil
    cdef void drive(self, Py_ssize_t world, bint old) noexcept nogil

cdef double limited(double desired, double before, double earlier, double dt, double* bounds) noexcept nogil
cdef double tangent(double angle) noexcept nogil
cdef double clipped(double value, double low, double high, double factor) noexcept nogil
