cimport cython

from gazelle.control.control_law cimport ControlLaw
from gazelle.control.pid_law cimport PidLaw

cdef class JointPidLaw(ControlLaw):
    cdef PidLaw pid
    cdef double[:, ::1] position, velocity, targets, error, command
    cdef Py_ssize_t[::1] joints, columns
    cdef unsigned char[::1] turning, endless
    cdef double[::1] lower, upper
    cdef bint by_velocity
    @cython.locals(i=Py_ssize_t, at=double, wanted=double, lack=double)
    cdef void control(self, Py_ssize_t world, long long now, double period) noexcept nogil
