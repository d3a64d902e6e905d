cimport cython

from gazelle.control.limit_law cimport LimitLaw
from gazelle.control.pid_law cimport PidLaw

cpdef enum:
    BY_EFFORT = 0
    BY_POSITION = 1
    BY_VELOCITY = 2
    BY_MOTOR = 3
    BY_PLACE = 4

@cython.final
cdef class JointLaw:
    cdef LimitLaw limits
    cdef PidLaw pid
    cdef double[:, ::1] measured, measured_rate, position, velocity, effort
    cdef double[:, ::1] applied, speed, placed_speed, previous, held, desired
    cdef double[:, ::1] effort_command, position_command, velocity_command
    cdef double[:, ::1] pushed
    cdef unsigned char[:, ::1] driven
    cdef unsigned char[::1] stopped, endless
    cdef double[::1] turning
    cdef bint placing, by_effort
    cdef Py_ssize_t count, first, width
    cdef double *measured_at, *measured_rate_at, *applied_at, *pushed_at
    cdef double *position_at, *velocity_at, *effort_at, *turning_at, *desired_at, *command_at
    cdef long long[::1] kinds
    cdef Py_ssize_t[::1] columns
    @cython.locals(i=Py_ssize_t, count=Py_ssize_t, first=Py_ssize_t, at="double*")
    cdef void read(self, Py_ssize_t world, double* measured, double* rates) noexcept nogil
    @cython.locals(i=Py_ssize_t, kind="long long", most=double, out=double)
    cdef void write(self, Py_ssize_t world, double period) noexcept nogil
    @cython.locals(i=Py_ssize_t, first=Py_ssize_t, stopped=bint, command="double*", at="double*", rate="double*", desired="double*", applied="double*")
    cdef void write_efforts(self, Py_ssize_t world) noexcept nogil
    @cython.locals(kind="long long", c=Py_ssize_t, value=double, before=double, at=double, rate=double)
    cdef double hold(self, Py_ssize_t world, Py_ssize_t i, double period) noexcept nogil
    @cython.locals(low=double, high=double)
    cdef double error(self, Py_ssize_t world, Py_ssize_t i, double desired) noexcept nogil
    @cython.locals(safe=double)
    cdef void push(self, Py_ssize_t world, Py_ssize_t i, double effort) noexcept nogil
    cdef void drive(self, Py_ssize_t world, Py_ssize_t i, double speed) noexcept nogil
    @cython.locals(w=Py_ssize_t, first=Py_ssize_t, measured="double*", rates="double*")
    cpdef read_all(self)
    @cython.locals(w=Py_ssize_t, since=double)
    cpdef write_all(self, double period)

@cython.locals(i=Py_ssize_t, turn=double, far=Py_ssize_t)
cdef bint follow(Py_ssize_t count, double* restrict position, double* restrict measured, double* restrict turning) noexcept nogil

@cython.locals(i=Py_ssize_t, low=double, high=double, held=double)
cdef void write_within(Py_ssize_t count, bint stopped, double* restrict command, double* restrict position, double* restrict velocity, double* restrict desired, double* restrict applied, double* restrict pushed, double* restrict lower, double* restrict upper, double* restrict fastest, double* restrict strongest) noexcept nogil
