cimport cython
from gazelle.geometry.ray_hits cimport TriangleRays


cdef class TriangleDistances:
    cdef TriangleRays tree
    cdef int[::1] waiting
    cdef double[::1] entry, point

    @cython.locals(n=Py_ssize_t, axis=int)
    cdef void measure(self, double[:, ::1] points, double enough, double[::1] squares) noexcept nogil
    @cython.locals(best=double, node=int, count=int, one=int, other=int, near=double, far=double)
    cdef double nearest(self, double enough) noexcept nogil
    @cython.locals(axis=int, total=double, below=double, above=double, away=double)
    cdef double square_to_box(self, int node, int side) noexcept nogil
    @cython.locals(t=double[:, ::1], p=double[::1], ux=double, uy=double, uz=double, vx=double,
                   vy=double, vz=double, x=double, y=double, z=double, uu=double, uv=double,
                   vv=double, pu=double, pv=double, pp=double, area=double, a=double, b=double,
                   nx=double, ny=double, nz=double, height=double, best=double, far=double)
    cdef double square_to(self, int face) noexcept nogil


cdef double square_to_line(double square, double along, double length) noexcept nogil
