cimport cython

from gazelle.control.control_law cimport ControlLaw
from gazelle.control.pid_law cimport PidLaw

cdef class GripperLaw(ControlLaw):
    cdef PidLaw pid
    cdef bint by_pid
    cdef double[:, ::1] position, velocity, command
    cdef double[::1] desired, most, output
    cdef Py_ssize_t joint, column
    @cython.locals(most=double, error=double, out=double)
    cdef void control(self, Py_ssize_t world, long long now, double period) noexcept nogil
