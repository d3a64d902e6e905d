cimport cython


@cython.final
cdef class ColoredFaces:
    cdef readonly double[:, ::1] faces
    cdef readonly Py_ssize_t still
    cdef readonly long long[:, ::1] spans
    cdef readonly double[::1] reach, floor, sky


@cython.final
cdef class PictureDrawing:
    cdef readonly ColoredFaces scene
    cdef double[:, ::1] rows, cameras, corners, spots
    cdef double[::1] paint
    cdef unsigned char[:, :, :, ::1] color
    cdef double[:, :, ::1] inverse
    cdef double fx, fy, near, far, reach
    cdef Py_ssize_t width, height
    cdef double x, y, z, cos, sin

    cdef void draw_one(self, Py_ssize_t n) noexcept nogil
    @cython.locals(
        color=cython.uchar[:, :, :, ::1], inverse=double[:, :, ::1], seen=cython.bint, near=double)
    cdef void draw_backdrop(self, Py_ssize_t n) noexcept nogil
    cdef void draw_faces(
        self, Py_ssize_t n, Py_ssize_t first, Py_ssize_t last, bint own) noexcept nogil
    @cython.locals(before=int, beyond=int, left=int, right=int, above=int, below=int)
    cdef bint is_in_view(self, Py_ssize_t n, Py_ssize_t f) noexcept nogil
    @cython.locals(count=Py_ssize_t, before=cython.bint, after=cython.bint)
    cdef Py_ssize_t project(self) noexcept nogil
    cdef void put_spot(
        self, Py_ssize_t count, double x, double y, double depth) noexcept nogil
    @cython.locals(low=double, high=double)
    cdef (double, double) row_of_polygon(self, Py_ssize_t count, double middle) noexcept nogil
    @cython.locals(top=double, bottom=double)
    cdef void fill(self, Py_ssize_t n, Py_ssize_t f, Py_ssize_t count) noexcept nogil
    @cython.locals(color=cython.uchar[:, :, :, ::1], inverse=double[:, :, ::1])
    cdef void fill_row(
        self, Py_ssize_t n, Py_ssize_t r, Py_ssize_t first, Py_ssize_t last, double row,
        double slope) noexcept nogil


cdef unsigned char byte(double shade) noexcept nogil
cdef Py_ssize_t first_middle(double edge, Py_ssize_t most) noexcept nogil
