cimport cython
from gazelle.geometry.polygon_rings cimport PolygonRings


cdef class PolygonJoiner:
    cdef PolygonRings rings
    cdef double[:, ::1] points, normals
    cdef double[::1] area, low, high, noise, rank, notch
    cdef Py_ssize_t[::1] tail, twin, label, sibling, best, edges, cells
    cdef Py_ssize_t[::1] waiting, first, last, small, large, rows
    cdef unsigned char[::1] notched, gone, seen, changed, taken, chosen
    cdef double lowest, highest

    @cython.locals(joined=Py_ssize_t, waiting=Py_ssize_t, pairs=Py_ssize_t, kept=Py_ssize_t,
                   left=Py_ssize_t, row=Py_ssize_t, edge=Py_ssize_t, one=Py_ssize_t, two=Py_ssize_t)
    cdef Py_ssize_t join_all(self, Py_ssize_t count, double tolerance, double depth) noexcept nogil
    @cython.locals(after=Py_ssize_t[::1], before=Py_ssize_t[::1], row=Py_ssize_t, edge=Py_ssize_t,
                   one=Py_ssize_t, two=Py_ssize_t, first=Py_ssize_t, back=Py_ssize_t,
                   found=Py_ssize_t)
    cdef Py_ssize_t find_seams(self, Py_ssize_t count) noexcept nogil
    @cython.locals(after=Py_ssize_t[::1], before=Py_ssize_t[::1], row=Py_ssize_t, first=Py_ssize_t,
                   last=Py_ssize_t, ahead=Py_ssize_t, one=Py_ssize_t, two=Py_ssize_t, swapped=bint)
    cdef Py_ssize_t find_pairs(self, Py_ssize_t count) noexcept nogil
    @cython.locals(kept=Py_ssize_t, row=Py_ssize_t, notch=double)
    cdef Py_ssize_t keep_fitting(self, Py_ssize_t count, Py_ssize_t waiting, double depth) noexcept nogil
    @cython.locals(one=Py_ssize_t, two=Py_ssize_t, first=Py_ssize_t, last=Py_ssize_t, axis=int,
                   along=double)
    cdef bint are_alike(self, Py_ssize_t row) noexcept nogil
    @cython.locals(after=Py_ssize_t[::1], before=Py_ssize_t[::1], first=Py_ssize_t, last=Py_ssize_t,
                   large=Py_ssize_t, one=double, other=double)
    cdef double deeper_notch(self, Py_ssize_t row) noexcept nogil
    @cython.locals(a=Py_ssize_t, b=Py_ssize_t, c=Py_ssize_t, ux=double, uy=double, uz=double,
                   vx=double, vy=double, vz=double, turn=double, x=double, y=double, z=double,
                   across=double, depth=double, ahead=double)
    cdef double notch_between(self, Py_ssize_t enter, Py_ssize_t leave, Py_ssize_t face) noexcept nogil
    @cython.locals(start=Py_ssize_t, end=Py_ssize_t, axis=int, seam=double, way=double, area=double)
    cdef double rank_of(self, Py_ssize_t row) noexcept nogil
    @cython.locals(left=Py_ssize_t, row=Py_ssize_t, k=Py_ssize_t, kept=Py_ssize_t, one=Py_ssize_t,
                   two=Py_ssize_t)
    cdef void choose(self, Py_ssize_t count) noexcept nogil
    @cython.locals(best=Py_ssize_t)
    cdef void offer(self, Py_ssize_t polygon, Py_ssize_t row) noexcept nogil
    @cython.locals(after=Py_ssize_t[::1], before=Py_ssize_t[::1], small=Py_ssize_t,
                   large=Py_ssize_t, first=Py_ssize_t, last=Py_ssize_t, end=Py_ssize_t,
                   edge=Py_ssize_t, enter=Py_ssize_t, leave=Py_ssize_t, enter_back=Py_ssize_t,
                   face=Py_ssize_t, uneven=bint)
    cdef bint take_out(self, Py_ssize_t row, double tolerance, double depth) noexcept nogil
    @cython.locals(base=Py_ssize_t, low=double, high=double, height=double, way=double,
                   face=Py_ssize_t, edge=Py_ssize_t, axis=int)
    cdef void measure(self, Py_ssize_t small, Py_ssize_t large) noexcept nogil
    cdef bint fills(self, Py_ssize_t first, Py_ssize_t last, Py_ssize_t large, double depth) noexcept nogil
