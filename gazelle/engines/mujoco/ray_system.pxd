from gazelle.native.ray_frames cimport FrameRays
from gazelle.native.system cimport System

cdef extern from "threads.h":
    long long gazelle_fetch_add(long long *counter, long long amount) noexcept nogil
    void gazelle_write(long long *place, long long value) noexcept nogil


cdef class RaySystem(System):
    cdef FrameRays rays
    cdef object spaces, groups, poses
    cdef readonly object ranges
    cdef size_t model, kinematics, ray, poses_at, group_at
    cdef size_t start_at, along_at, distance_at, geom_at, normal_at
    cdef long long[:, ::1] table
    cdef long long[::1] bodies
    cdef const double[::1] beside
    cdef const double[:, :] qpos
    cdef const double[:, :, :] mocap_pos, mocap_quat
    cdef const unsigned char[::1] sheets
    cdef Py_ssize_t take(self) noexcept nogil
    cdef void give(self, Py_ssize_t space) noexcept nogil
    cdef void place(self, Py_ssize_t space, Py_ssize_t world) noexcept nogil
    cdef void cast(self, Py_ssize_t space, Py_ssize_t world, Py_ssize_t frame) noexcept nogil
    cdef void update(self, Py_ssize_t first, Py_ssize_t last, long long time) noexcept nogil
