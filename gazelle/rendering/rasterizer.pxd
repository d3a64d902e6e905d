cimport cython


@cython.final
cdef class DrawnShapes:
    cdef readonly double[:, ::1] vertices, normals, spheres, local, uv
    cdef readonly int[:, ::1] faces
    cdef readonly long long[:, ::1] meshes, parts
    cdef readonly float[:, ::1] color, glow
    cdef readonly float[::1] alpha
    cdef readonly bint clear
    cdef readonly long long[:, ::1] textures
    cdef readonly unsigned char[:, ::1] texels


@cython.final
cdef class Rasterizer:
    cdef readonly DrawnShapes shapes
    cdef readonly double[:, :, ::1] links
    cdef readonly double[:, ::1] cameras
    cdef readonly Py_ssize_t width, height
    cdef readonly double fx, fy, cx, cy, near, far
    cdef readonly float[:, ::1] inverse
    cdef readonly int[:, ::1] owner
    cdef readonly int[::1] part_of, face_of, slot_of
    cdef readonly double[:, ::1] placed
    cdef Py_ssize_t count
    cdef double[:, ::1] seen, spots, cut
    cdef double[::1] sides
    cdef double plane_x, plane_y, plane_0
    cdef size_t inverse_at, owner_at

    cdef void draw(self, Py_ssize_t n) noexcept nogil
    @cython.locals(r=Py_ssize_t, c=Py_ssize_t)
    cdef void draw_clear(self, Py_ssize_t n) noexcept nogil
    cdef void draw_parts(self, Py_ssize_t n, bint clear) noexcept nogil
    @cython.locals(inverse=cython.p_float, owner=cython.p_int, least=cython.float, k=Py_ssize_t)
    cdef void clear(self) noexcept nogil
    @cython.locals(dx=double, dy=double, dz=double, link=Py_ssize_t, world=Py_ssize_t, a=double,
                   b=double, c=double, x=double)
    cdef void place(self, Py_ssize_t n, Py_ssize_t p) noexcept nogil
    @cython.locals(x=double, y=double, z=double, reach=double, mesh=Py_ssize_t)
    cdef bint is_in_view(self, Py_ssize_t p) noexcept nogil
    @cython.locals(x=double, y=double, z=double, a=double, b=double, c=double, first=Py_ssize_t,
                   v=Py_ssize_t, mesh=Py_ssize_t, over=double)
    cdef void project(self, Py_ssize_t p) noexcept nogil
    @cython.locals(two_sided=cython.bint, i=Py_ssize_t, j=Py_ssize_t, k=Py_ssize_t, behind=int,
                   first=Py_ssize_t, f=Py_ssize_t, mesh=Py_ssize_t)
    cdef void draw_part(self, Py_ssize_t p) noexcept nogil
    @cython.locals(ax=double, ay=double, bx=double, by=double, cx=double, cy=double,
                   twice=double, left=double, right=double, top=double, bottom=double)
    cdef void draw_face(
        self, Py_ssize_t p, Py_ssize_t f, Py_ssize_t i, Py_ssize_t j, Py_ssize_t k,
        bint two_sided) noexcept nogil
    @cython.locals(m=Py_ssize_t, here=double, there=double, t=double, a=Py_ssize_t, b=Py_ssize_t,
                   before=cython.bint, after=cython.bint, x=double, y=double)
    cdef void draw_cut_face(
        self, Py_ssize_t p, Py_ssize_t f, Py_ssize_t i, Py_ssize_t j, Py_ssize_t k,
        bint two_sided) noexcept nogil
    cdef void put_cut(self, Py_ssize_t m, double x, double y, double z) noexcept nogil
    @cython.locals(x0=double, y0=double, z0=double, ax=double, ay=double, az=double, bx=double,
                   by=double, bz=double, nx=double, ny=double, nz=double, off=double)
    cdef bint find_plane(
        self, Py_ssize_t i, Py_ssize_t j, Py_ssize_t k, bint two_sided) noexcept nogil
    cdef void record(self, Py_ssize_t p, Py_ssize_t f) noexcept nogil
    @cython.locals(r=Py_ssize_t, middle=double, a=double, b=double, long=double, upper=double,
                   lower=double, t=double)
    cdef void fill(
        self, double x0, double y0, double x1, double y1, double x2, double y2) noexcept nogil
    @cython.locals(
        inverse=cython.p_float, owner=cython.p_int, at=cython.float, slope=cython.float,
        near=cython.float, c=int, count=int, mine=int, closer=cython.bint, first=int,
        start=Py_ssize_t)
    cdef void fill_row(self, Py_ssize_t r, double low, double high) noexcept nogil


cdef int first_middle(double edge, Py_ssize_t most) noexcept nogil
