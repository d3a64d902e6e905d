cimport cython

from gazelle.engines.planar.bodies cimport Bodies
from gazelle.native.system cimport System

cdef enum:
    WIDE = 8  # bodies that are moved at once
    # Rows of a table with a column for each of them.
    M_X = 0
    M_Y = 8
    M_YAW = 16
    M_COS = 24
    M_SIN = 32
    M_FORWARD = 40
    M_ASIDE = 48
    M_ANGLE = 56
    M_TURN_COS = 64
    M_TURN_SIN = 72
    M_STEPS = 80
    M_ALL = 88

cdef class Moving(System):
    cdef Bodies bodies
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    cdef void update_steps(
        self, Py_ssize_t first, Py_ssize_t last, long long time, Py_ssize_t count) noexcept nogil

@cython.locals(
    world=Py_ssize_t, left=Py_ssize_t, steps=Py_ssize_t, pause=Py_ssize_t, queued=Py_ssize_t,
    k=Py_ssize_t, b=Py_ssize_t, _=Py_ssize_t)
cdef void advance_worlds(
    Bodies w, Py_ssize_t first, Py_ssize_t last, Py_ssize_t count) noexcept nogil
cdef void advance_queued(
    Bodies w, double *table, Py_ssize_t *which, Py_ssize_t number) noexcept nogil
@cython.locals(k=Py_ssize_t, most=double)
cdef Py_ssize_t steps_alike(
    Bodies w, Py_ssize_t world, Py_ssize_t left, bint fresh) noexcept nogil
cdef double free_steps(
    Bodies w, Py_ssize_t world, Py_ssize_t k, double longest, double most) noexcept nogil
@cython.locals(row=Py_ssize_t, cell=Py_ssize_t, gap=double)
cdef double gap_around(Bodies w, Py_ssize_t world, Py_ssize_t k, double most) noexcept nogil
@cython.locals(b=Py_ssize_t, gap=double)
cdef double gap_in(
    Bodies w, Py_ssize_t world, Py_ssize_t k, Py_ssize_t cell, double most) noexcept nogil
cdef void load(
    Bodies w, Py_ssize_t b, Py_ssize_t k, Py_ssize_t steps, double *table, Py_ssize_t column
) noexcept nogil
@cython.locals(i=Py_ssize_t, k=Py_ssize_t, most=double, yaw=double, unit=double, going=bint)
cdef void drive(double *table, Py_ssize_t number) noexcept nogil
@cython.locals(i=Py_ssize_t, b=Py_ssize_t)
cdef void store(
    Bodies w, double *table, Py_ssize_t *which, Py_ssize_t number) noexcept nogil
