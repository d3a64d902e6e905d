cimport cython


cdef class FrameRays:
    cdef readonly object start, along, distance, normal, geom, passed, inside
    cdef const double[:, :, ::1] carried, pointed
    cdef double[:, :, ::1] starts, alongs
    cdef double[:, :, ::1] normals
    cdef double[:, ::1] distances
    cdef int[:, ::1] geoms
    cdef unsigned char[:, ::1] insides
    @cython.locals(n=Py_ssize_t, frame=Py_ssize_t)
    cdef void point(
        self, const double[:, :, ::1] position, const double[:, :, ::1] quaternion,
        const double[::1] beside) noexcept
    @cython.locals(ray=Py_ssize_t, rays=Py_ssize_t, at=Py_ssize_t, a=double, b=double, c=double, i=double, j=double, k=double)
    cdef void point_frame(
        self, Py_ssize_t n, Py_ssize_t frame, double px, double py, double pz,
        double x, double y, double z, double w) noexcept nogil
    @cython.locals(n=Py_ssize_t)
    cdef void judge(self, const unsigned char[::1] sheet, bint signed) noexcept
    @cython.locals(ray=Py_ssize_t, out=double, geom=int, within=bint)
    cdef void judge_some(
        self, Py_ssize_t n, Py_ssize_t first, Py_ssize_t last, const unsigned char[::1] sheet,
        bint signed) noexcept nogil
