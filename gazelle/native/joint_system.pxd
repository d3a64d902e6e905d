cimport cython

from gazelle.native.system cimport System

cdef class JointSystem(System):
    cdef readonly object position_in, velocity_in, effort_out, pushed_out, speed_out, driven_out
    cdef double[:, ::1] position, velocity, effort, speed, pushed
    cdef unsigned char[:, ::1] driven
    cdef Py_ssize_t[::1] places, dofs, motors
    cdef Py_ssize_t count, first_place, first_dof
    cdef double *position_at, *velocity_at, *effort_at, *most_at, *pushed_at
    cdef unsigned char *driven_at
    cdef Py_ssize_t *dofs_at
    cdef double[::1] most
    cdef bint moves
    cdef void advance(self, Py_ssize_t world, double* measured, double* rates, long long time) noexcept nogil
    @cython.locals(w=Py_ssize_t, measured="double*", rates="double*")
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    @cython.locals(i=Py_ssize_t, most=double, value=double, count=Py_ssize_t, first=Py_ssize_t, measured="double*", rates="double*", effort="double*", pushed="double*")
    cdef void exchange(self, Py_ssize_t world, double* qpos, double* qvel, double* applied, double* user, long long time) noexcept nogil
    @cython.locals(i=Py_ssize_t, count=Py_ssize_t, driven="unsigned char*")
    cdef void drive(self, Py_ssize_t world, double* user) noexcept nogil

@cython.locals(i=Py_ssize_t)
cdef void copy(Py_ssize_t count, double* restrict start, double* restrict end) noexcept nogil

@cython.locals(i=Py_ssize_t, held=double)
cdef void act_in_row(Py_ssize_t count, double* restrict effort, double* restrict pushed, double* restrict most, double* restrict applied) noexcept nogil
