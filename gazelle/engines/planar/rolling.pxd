cimport cython

from gazelle.engines.planar.bodies cimport Bodies
from gazelle.native.system cimport System

cdef enum:
    WIDE = 16  # joints that are turned at once

cdef class Joints:
    cdef public double[:, ::1] angles, rates, targets, limits, matrix
    cdef public Py_ssize_t[::1] base, first, column

cdef class Rolling(System):
    cdef Bodies bodies
    cdef Joints joints
    @cython.locals(world=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef class Turning(System):
    cdef Bodies bodies
    cdef Joints joints
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    @cython.locals(axes=Py_ssize_t, start=Py_ssize_t, end=Py_ssize_t)
    cdef void update_steps(
        self, Py_ssize_t first, Py_ssize_t last, long long time, Py_ssize_t count) noexcept nogil

@cython.locals(j=Py_ssize_t, speed=double)
cdef void drive_joints(Joints own, Py_ssize_t world) noexcept nogil
@cython.locals(i=Py_ssize_t, j=Py_ssize_t, axis=Py_ssize_t, b=Py_ssize_t, speed=double)
cdef void drive_bases(Joints own, Bodies w, Py_ssize_t world) noexcept nogil
@cython.locals(i=Py_ssize_t, world=Py_ssize_t, j=Py_ssize_t, _=Py_ssize_t, angle=double)
cdef void turn(
    Joints own, Py_ssize_t start, Py_ssize_t number, Py_ssize_t count, double dt) noexcept nogil
