cimport cython

from gazelle.control.control_law cimport ControlLaw
from gazelle.control.joint_law cimport JointLaw
from gazelle.control.pid_law cimport PidLaw

cdef class JointPidLaw(ControlLaw):
    cdef PidLaw pid
    cdef JointLaw hardware
    cdef object measures, commands
    cdef double[:, ::1] position, velocity, targets, error, command
    cdef double[::1] turning, lower, upper
    cdef Py_ssize_t[::1] joints, columns
    cdef Py_ssize_t[:, ::1] runs
    cdef Py_ssize_t *joints_at, *columns_at
    cdef Py_ssize_t count, width, command_width
    cdef double *position_at, *velocity_at, *targets_at, *error_at, *command_at
    cdef double *turning_at, *lower_at, *upper_at
    cdef bint by_velocity
    @cython.locals(i=Py_ssize_t)
    cdef void control(self, Py_ssize_t world, long long now, double period) noexcept nogil
    @cython.locals(j=Py_ssize_t, k=Py_ssize_t, at=double, target=double, error=double)
    cdef void control_joint(self, Py_ssize_t world, Py_ssize_t i, double period) noexcept nogil
    @cython.locals(r=Py_ssize_t)
    cdef void exchange(self, Py_ssize_t world, double* measured, double* rates, double period) noexcept nogil
    @cython.locals(s=Py_ssize_t, k=Py_ssize_t, c=Py_ssize_t, j=Py_ssize_t, each=Py_ssize_t, own="double*")
    cdef void exchange_run(self, Py_ssize_t world, Py_ssize_t first, Py_ssize_t count, double* measured, double* rates, double period) noexcept nogil

@cython.locals(i=Py_ssize_t, far=Py_ssize_t, moved=double, way=double)
cdef bint are_near(Py_ssize_t count, double* restrict position, double* restrict measured, double* restrict targets, double* restrict values, double* restrict lower, double* restrict upper) noexcept nogil

@cython.locals(i=Py_ssize_t, at=double, rate=double, error=double, change=double, whole=double, out=double)
cdef void hold(Py_ssize_t count, bint stopped, bint by_velocity, double dt, double* restrict measured, double* restrict rates, double* restrict follows, double* restrict position, double* restrict velocity, double* restrict effort, double* restrict applied, double* restrict pushed, double* restrict command, double* restrict targets, double* restrict errors, double* restrict last, double* restrict p_error, double* restrict i_error, double* restrict d_error, double* restrict output, double* restrict p, double* restrict i_gain, double* restrict d, double* restrict sum_least, double* restrict sum_most, double* restrict term_least, double* restrict term_most, double* restrict lower, double* restrict upper, double* restrict turning, double* restrict least, double* restrict most, double* restrict fastest, double* restrict strongest) noexcept nogil
