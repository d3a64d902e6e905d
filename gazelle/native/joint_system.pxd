cimport cython

from gazelle.native.system cimport System

cdef class JointSystem(System):
    cdef readonly object position_in, velocity_in, effort_out, pushed_out, speed_out, driven_out
    cdef double[:, ::1] position, velocity, effort, speed
    cdef unsigned char[:, ::1] pushed, driven
    cdef Py_ssize_t[::1] places, dofs, motors
    cdef Py_ssize_t count, first_place, first_dof
    cdef double *position_at, *velocity_at, *effort_at, *most_at
    cdef unsigned char *pushed_at, *driven_at
    cdef Py_ssize_t *dofs_at
    cdef double[::1] most
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    @cython.locals(i=Py_ssize_t, most=double, value=double, count=Py_ssize_t, first=Py_ssize_t, position="double*", velocity="double*", effort="double*", pushed="unsigned char*", driven="unsigned char*")
    cdef void exchange(self, Py_ssize_t world, double* qpos, double* qvel, double* applied, double* user, long long time) noexcept nogil

@cython.locals(i=Py_ssize_t)
cdef void copy(Py_ssize_t count, double* restrict start, double* restrict end) noexcept nogil


@cython.locals(index=Py_ssize_t, place="void*")
cdef void bring_systems(long long* table, Py_ssize_t count, Py_ssize_t world, double* qpos, double* qvel, double* applied, double* user, long long time) noexcept nogil
