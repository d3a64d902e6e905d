cimport cython

from gazelle.engines.planar.bodies cimport Bodies
from gazelle.native.system cimport System

@cython.locals(b=Py_ssize_t, longest=double)
cdef double plan(Bodies w, Py_ssize_t first, Py_ssize_t last, double dt) noexcept nogil
@cython.locals(b=Py_ssize_t)
cdef void screen(Bodies w, Py_ssize_t first, Py_ssize_t last, double reach) noexcept nogil
@cython.locals(b=Py_ssize_t)
cdef void settle(Bodies w, Py_ssize_t first, Py_ssize_t last, double reach) noexcept nogil
@cython.locals(_=Py_ssize_t, reach=double)
cdef void advance_bodies(
    Bodies w, Py_ssize_t first, Py_ssize_t last, Py_ssize_t count, double dt) noexcept nogil
@cython.locals(parts=Py_ssize_t)
cdef void advance_world(Bodies w, Py_ssize_t world) noexcept nogil
cdef void settle_world(Bodies w, Py_ssize_t world) noexcept nogil
@cython.locals(b=Py_ssize_t, longest=double)
cdef double reach_in(Bodies w, Py_ssize_t world) noexcept nogil

cdef class Planning(System):
    cdef Bodies bodies
    @cython.locals(b=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef class Screening(System):
    cdef Bodies bodies
    @cython.locals(b=Py_ssize_t, end=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil

cdef class Settling(System):
    cdef Bodies bodies
    @cython.locals(world=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
