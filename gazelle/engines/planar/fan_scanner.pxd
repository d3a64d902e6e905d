cimport cython
from cpython.pythread cimport (
    PyThread_acquire_lock, PyThread_allocate_lock, PyThread_free_lock, PyThread_release_lock,
    PyThread_type_lock)
from gazelle.engines.planar.beams cimport Beams, Candidates
from gazelle.engines.planar.bodies cimport Bodies
from gazelle.engines.planar.front_faces cimport FrontFaces
from gazelle.engines.planar.lanes cimport Lanes
from gazelle.engines.planar.viewpoint cimport Viewpoint
from gazelle.native.system cimport System


cdef class FanScanner(System):
    cdef public FanScanner next
    cdef readonly Bodies bodies
    cdef readonly Beams beams
    cdef Viewpoint at
    cdef Lanes lanes
    cdef FrontFaces front
    cdef Candidates found
    cdef double[:, ::1] mounts, middles
    cdef double[::1] begins
    cdef public double[::1] spread
    cdef public long long[::1] owners
    cdef public double[:, ::1] ranges, names
    cdef public double missing, constant, share, step
    cdef public bint signed
    cdef public int way
    cdef public long long seed
    cdef PyThread_type_lock lock

    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
    cdef void work(
        self, long long[::1] owners, Py_ssize_t first, Py_ssize_t last, long long tick,
        Py_ssize_t part) noexcept nogil
    cdef void scan_all(
        self, long long[::1] owners, Py_ssize_t first, Py_ssize_t last) noexcept nogil
    cdef void scan_one(self, Py_ssize_t m) noexcept nogil
    @cython.locals(crowded=cython.bint)
    cdef void scan_crowded(
        self, long long[::1] owners, Py_ssize_t first, Py_ssize_t last) noexcept nogil
    @cython.locals(begin=Py_ssize_t, end=Py_ssize_t)
    cdef void scan_singly(
        self, long long[::1] owners, Py_ssize_t first, Py_ssize_t last) noexcept nogil
    @cython.locals(base=Py_ssize_t, count=Py_ssize_t)
    cdef void scan_with_angle_noise(
        self, long long[::1] owners, Py_ssize_t first, Py_ssize_t last,
        long long tick) noexcept nogil
    @cython.locals(true=double)
    cdef void blur(
        self, long long[::1] owners, Py_ssize_t first, Py_ssize_t last,
        long long tick) noexcept nogil


@cython.locals(end=Py_ssize_t, whole=Py_ssize_t)
cdef Py_ssize_t end_of(
    long long[::1] owners, Py_ssize_t first, Py_ssize_t last, Py_ssize_t most) noexcept nogil
