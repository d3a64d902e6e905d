cimport cython
from gazelle.engines.planar.beams cimport Beams, Candidates
from gazelle.engines.planar.viewpoint cimport Viewpoint


@cython.final
cdef class FrontFaces:
    cdef double[:, ::1] discs, rounds
    cdef double[::1] table
    cdef Py_ssize_t statics
    cdef long long[:, ::1] spans
    cdef long long[::1] order
    cdef Candidates found
    cdef double inside
    cdef Py_ssize_t listed

    @cython.locals(
        level=cython.bint, near=cython.bint, front=cython.bint, closed=cython.bint, up=cython.bint,
        down=cython.bint, touched=cython.bint, n=Py_ssize_t)
    cdef Py_ssize_t find_faces(
        self, Py_ssize_t n, Py_ssize_t first, Py_ssize_t last, double reach, double height, double x, double y, double cos,
        double sin) noexcept nogil
    cdef bint take_disc(self, double x, double y, double radius, Beams beams) noexcept nogil
    cdef Py_ssize_t find_bodies(self, Viewpoint at, Beams beams) noexcept nogil
    cdef void draw(self, Py_ssize_t n, Beams beams) noexcept nogil
    cdef bint look(self, Viewpoint at, Beams beams) noexcept nogil
