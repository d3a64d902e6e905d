cimport cython

from gazelle.control.control_law cimport ControlLaw
from gazelle.control.pid_law cimport PidLaw

cpdef enum:
    NOTHING = 0
    STRAYED = 1
    LATE = 2
    THERE = 3

cdef class TrajectoryLaw(ControlLaw):
    cdef PidLaw pid
    cdef bint by_pid, places, speeds, bends
    cdef double[:, ::1] position, velocity, desired_position, desired_velocity, desired_acceleration
    cdef double[:, ::1] position_command, velocity_command, acceleration_command, effort_command
    cdef Py_ssize_t[::1] joints, columns
    cdef double[::1] forward, uptime, period, patience, event_error
    cdef double[:, :, ::1] start, duration, path, end, acting
    cdef double[:, :, :, ::1] polynomials
    cdef long long[:, :, ::1] goals
    cdef Py_ssize_t[:, ::1] at
    cdef long long[::1] goal, event, event_goal, event_joint
    cdef unsigned char[:, ::1] reached
    @cython.locals(c=Py_ssize_t, last=Py_ssize_t, k=Py_ssize_t)
    cdef Py_ssize_t segment(self, Py_ssize_t world, Py_ssize_t joint, double time) noexcept nogil
    @cython.locals(t=double, lasting=double, moving=double, c0=double, c1=double, c2=double, c3=double, c4=double, c5=double)
    cdef void sample(self, Py_ssize_t world, Py_ssize_t joint, double time) noexcept nogil
    @cython.locals(i=Py_ssize_t, c=Py_ssize_t, time=double, error=double, velocity_error=double, missed=bint, all_there=bint)
    cdef void control(self, Py_ssize_t world, long long now, double period) noexcept nogil
    @cython.locals(end=double, there=bint)
    cdef void check_tolerances(self, Py_ssize_t world, Py_ssize_t i, Py_ssize_t c, double time, double error, double velocity_error) noexcept nogil
    cdef void command(self, Py_ssize_t world, Py_ssize_t i, double error, double velocity_error, double period) noexcept nogil
    cdef void report(self, Py_ssize_t world, long long code, Py_ssize_t joint, double error) noexcept nogil

cdef bint within(double position, double velocity, double far, double fast) noexcept nogil
