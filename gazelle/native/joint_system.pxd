cimport cython

from gazelle.native.system cimport System

cdef class JointSystem(System):
    cdef readonly object position_in, velocity_in, effort_out, pushed_out, speed_out, driven_out
    cdef double[:, ::1] position, velocity, effort, speed
    cdef unsigned char[:, ::1] pushed, driven
    cdef Py_ssize_t[::1] places, dofs, motors
    cdef double[::1] most
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    @cython.locals(i=Py_ssize_t, most=double, value=double)
    cdef void exchange(self, Py_ssize_t world, double* qpos, double* qvel, double* applied, double* user, long long time) noexcept nogil


@cython.locals(index=Py_ssize_t, place="void*")
cdef void bring_systems(long long* table, Py_ssize_t count, Py_ssize_t world, double* qpos, double* qvel, double* applied, double* user, long long time) noexcept nogil
