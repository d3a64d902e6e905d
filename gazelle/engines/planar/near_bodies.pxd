cimport cython
from gazelle.engines.planar.beams cimport Candidates
from gazelle.engines.planar.lanes cimport Lanes


cdef Py_ssize_t take_nearest(Candidates found, Py_ssize_t count) noexcept nogil
@cython.locals(passed=cython.bint)
cdef void meet_some(
    Lanes lanes, Py_ssize_t first, Py_ssize_t last, Candidates found, Py_ssize_t n,
    Py_ssize_t base) noexcept nogil
@cython.locals(left=double, right=double, low=double, high=double)
cdef (Py_ssize_t, Py_ssize_t, Py_ssize_t, Py_ssize_t) cells_near(
    Lanes lanes, Py_ssize_t first, Py_ssize_t last) noexcept nogil
@cython.locals(begin=Py_ssize_t, end=Py_ssize_t, bottom=Py_ssize_t, top=Py_ssize_t)
cdef void meet_bodies(
    Lanes lanes, Py_ssize_t first, Py_ssize_t last, Candidates found, Py_ssize_t me) noexcept nogil
