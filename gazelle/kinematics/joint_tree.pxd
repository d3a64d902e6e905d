cdef class JointTree:
    cdef int[::1] _parents
    cdef double[:, ::1] _origins
    cdef double[:, ::1] _axes
    cdef unsigned char[::1] _slides
    cdef int[::1] _columns
    cdef double[::1] _multipliers
    cdef double[::1] _offsets
    cdef readonly int joints
    cdef void place(self, int joint, double[:, ::1] frames, double[::1] variables) noexcept nogil
    cdef void motion(
        self, int joint, double[:, ::1] frames, double[:, ::1] tip, double[::1] out) noexcept nogil


cdef void compose(double[:, ::1] first, int i, double[:, ::1] second, int j, double[:, ::1] made, int k) noexcept nogil
