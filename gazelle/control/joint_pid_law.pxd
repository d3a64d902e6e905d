cimport cython

from gazelle.control.control_law cimport ControlLaw
from gazelle.control.pid_law cimport PidLaw

cdef class JointPidLaw(ControlLaw):
    cdef PidLaw pid
    cdef double[:, ::1] position, velocity, targets, error, command, read_row, push_row
    cdef Py_ssize_t[::1] joints, columns
    cdef Py_ssize_t count, first_joint, first_column, width, command_width
    cdef double *measured_at, *targets_at, *error_at, *command_at
    cdef double *turning_at, *lower_at, *upper_at
    cdef double[::1] turning, lower, upper
    cdef bint by_velocity
    @cython.locals(i=Py_ssize_t, first=Py_ssize_t, at="double*", out="double*", error="double*", targets="double*", near=bint)
    cdef void control(self, Py_ssize_t world, long long now, double period) noexcept nogil
    @cython.locals(i=Py_ssize_t, at="double*", values="double*")
    cdef double* measured(self, Py_ssize_t world) noexcept nogil

@cython.locals(i=Py_ssize_t)
cdef void velocity_errors(Py_ssize_t count, double* restrict at, double* restrict targets, double* restrict error) noexcept nogil

@cython.locals(i=Py_ssize_t, difference=double, far=Py_ssize_t)
cdef bint position_errors(Py_ssize_t count, double* restrict at, double* restrict targets, double* restrict error, double* restrict lower, double* restrict upper, double* restrict turning) noexcept nogil
