cimport cython

from gazelle.native.system cimport System

cdef class PathSystem(System):
    cdef public double[:, ::1] legs
    cdef public double[::1] start, spin, epoch
    cdef public bint loop
    @cython.locals(leg=Py_ssize_t, last=Py_ssize_t)
    cdef Py_ssize_t leg(self, double moment) noexcept nogil
    @cython.locals(begin=double, end=double)
    cdef double moment(self, double elapsed) noexcept nogil

cdef class PosePath(PathSystem):
    cdef double[:, :] position, quaternion
    cdef double[::1] arm, moved
    cdef bint plain
    @cython.locals(world=Py_ssize_t, elapsed=double)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    @cython.locals(leg=Py_ssize_t, since=double, moment=double)
    cdef void go(self, Py_ssize_t world, double elapsed) noexcept nogil
    @cython.locals(rate=double, half=double, share=double, x=double, y=double, z=double, w=double, a=double, b=double, c=double, d=double)
    cdef void turn(self, Py_ssize_t world, double elapsed) noexcept nogil
    @cython.locals(norm=double, a=double, b=double, c=double, d=double, i=double, j=double, k=double)
    cdef void write(self, Py_ssize_t world, double px, double py, double pz, double x, double y, double z, double w) noexcept nogil
    cdef void place(self, Py_ssize_t world, double x, double y, double z) noexcept nogil
    @cython.locals(norm=double)
    cdef void face(self, Py_ssize_t world, double x, double y, double z, double w) noexcept nogil
