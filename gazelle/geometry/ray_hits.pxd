cimport cython


cdef class TriangleRays:
    cdef double[:, :, ::1] bounds
    cdef double[:, ::1] triangles
    cdef int[:, ::1] children
    cdef int[::1] waiting
    cdef double[::1] entry, ray
    cdef double size, tie, nearest
    cdef int root
    cdef bint leaves

    @cython.locals(n=Py_ssize_t, axis=int, way=double, ray=double[::1])
    cdef void cast(self, double[:, ::1] origins, double[:, ::1] directions, double[::1] distance,
                   unsigned char[::1] within) noexcept nogil
    @cython.locals(found=bint, node=int, count=int, one=int, other=int, near=double, far=double)
    cdef bint find_first(self) noexcept nogil
    @cython.locals(begin=double, end=double, one=double, other=double, axis=int, turned=int,
                   inverse=double, place=double)
    cdef double enters(self, int node, int side) noexcept nogil
    @cython.locals(ray=double[::1], t=double[:, ::1], px=double, py=double, pz=double,
                   volume=double, sx=double, sy=double, sz=double, qx=double, qy=double, qz=double,
                   u=double, v=double, away=double)
    cdef bint meets(self, int face) noexcept nogil
