cimport cython


cdef class HullBuilder:
    cdef readonly Py_ssize_t most
    cdef public double scale
    cdef public int faces
    cdef int freed, waiting, edges, visible
    cdef long long[:, ::1] place, normal
    cdef double[::1] low
    cdef int[:, ::1] corner, across, rim
    cdef int[::1] first, seen, waits, queue, patch, free, after, begins

    @cython.locals(count=Py_ssize_t, face=int)
    cdef bint build(self, double[:, ::1] points) noexcept nogil
    @cython.locals(used=int[::1], found=int, i=int, face=int)
    cdef int write_corners(self, int count, int[::1] rows) noexcept nogil
    @cython.locals(count=Py_ssize_t, i=Py_ssize_t, axis=Py_ssize_t, low=double, high=double,
                   span=double, steps=double)
    cdef void put_on_grid(self, double[:, ::1] points) noexcept nogil
    @cython.locals(a=int)
    cdef long long height(self, int face, long long x, long long y, long long z) noexcept nogil
    cdef bint sees(self, int point, int face) noexcept nogil
    @cython.locals(face=int)
    cdef int holds(self, double x, double y, double z, int last) noexcept nogil
    @cython.locals(a=int)
    cdef bint is_before(self, int face, double x, double y, double z) noexcept nogil
    @cython.locals(face=int, ux=cython.longlong, uy=cython.longlong, uz=cython.longlong, vx=cython.longlong, vy=cython.longlong, vz=cython.longlong)
    cdef int put(self, int a, int b, int c) noexcept nogil
    @cython.locals(a=int, b=int, c=int, d=int, i=int, face=int, most=cython.longlong, height=cython.longlong)
    cdef bint begin(self, int count) noexcept nogil
    @cython.locals(face=int, other=int, i=int, j=int, tail=int, head=int)
    cdef void join_first(self) noexcept nogil
    @cython.locals(far=int, i=int, most=double, away=double, x=double, y=double, z=double)
    cdef int farthest_from(self, int a, int b, int count) noexcept nogil
    @cython.locals(face=int)
    cdef void give(self, int point, int begin, int end) noexcept nogil
    cdef void wait_for(self, int face) noexcept nogil
    @cython.locals(best=int, point=int, most=cython.longlong, height=cython.longlong)
    cdef int farthest(self, int face) noexcept nogil
    @cython.locals(orphan=int, next_one=int, k=int, j=int, tail=int, head=int, beyond=int, made=int,
                   after=int, count=int)
    cdef void add(self, int point, int face) noexcept nogil
    @cython.locals(count=int, k=int, i=int, here=int, beyond=int)
    cdef void look(self, int point, int face) noexcept nogil
    @cython.locals(orphan=int, k=int, face=int, other=int, next_one=int)
    cdef int take_away(self, int point) noexcept nogil
