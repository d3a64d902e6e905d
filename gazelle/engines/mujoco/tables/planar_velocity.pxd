cimport cython

from gazelle.native.system cimport System

cdef class LevelMotion(System):
    cdef const double[:, :, :] linear, angular
    cdef const double[:, :] qpos
    cdef double[:, :] qvel
    cdef const Py_ssize_t[:, ::1] places
    cdef const double[:, ::1] frames
    cdef const Py_ssize_t[::1] dofs, start
    cdef double[::1] changed
    @cython.locals(row=Py_ssize_t)
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    @cython.locals(place=Py_ssize_t, dof=Py_ssize_t, k=Py_ssize_t, w=double, x=double, y=double, z=double, a=double, b=double, c=double, d=double, p=double, q=double, r=double, s=double, sine=double, cosine=double, length=double, u=double, v=double, t=double, ax=double, ay=double, ahead=double, across=double, rate=double)
    cdef void move(self, Py_ssize_t world, Py_ssize_t i) noexcept nogil
