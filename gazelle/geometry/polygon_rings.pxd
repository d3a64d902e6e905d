cimport cython


cdef class PolygonRings:
    cdef Py_ssize_t[::1] after, before, start
    cdef Py_ssize_t count, kept
    cdef double[:, ::1] points, normals, place, axes
    cdef Py_ssize_t[::1] tail, edge, hull
    cdef unsigned char[::1] inside
    cdef double squares, along

    @cython.locals(total=Py_ssize_t, row=Py_ssize_t, first=Py_ssize_t, k=Py_ssize_t,
                   edge=Py_ssize_t)
    cdef Py_ssize_t write(self, Py_ssize_t[::1] faces, unsigned char[::1] notched,
                          Py_ssize_t[::1] corners, Py_ssize_t[::1] sizes) noexcept nogil
    @cython.locals(axis=int, other=int, u=int, v=int, x=double, y=double, z=double, a=double,
                   b=double, c=double, length=double)
    cdef void begin(self, Py_ssize_t face) noexcept nogil
    cdef void add(self, Py_ssize_t edge, Py_ssize_t end) noexcept nogil
    @cython.locals(point=Py_ssize_t, x=double, y=double, axis=int)
    cdef void put(self, Py_ssize_t edge) noexcept nogil
    @cython.locals(kept=Py_ssize_t, k=Py_ssize_t, turn=double, squares=double)
    cdef void find_hull(self) noexcept nogil
    @cython.locals(here=Py_ssize_t, before=Py_ssize_t, after=Py_ssize_t, ux=double, uy=double,
                   vx=double, vy=double)
    cdef double turn_at(self, Py_ssize_t k) noexcept nogil
    @cython.locals(whole=double, k=Py_ssize_t, turn=double)
    cdef bint turns_once(self) noexcept nogil
    @cython.locals(deepest=double, side=Py_ssize_t, k=Py_ssize_t, after=Py_ssize_t, one=Py_ssize_t,
                   two=Py_ssize_t, x=double, y=double, height=double)
    cdef double deepest(self) noexcept nogil
