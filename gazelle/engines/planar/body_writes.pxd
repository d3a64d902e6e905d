cimport cython

from gazelle.engines.planar.bodies cimport Bodies

@cython.locals(i=Py_ssize_t, b=Py_ssize_t)
cdef void write_poses(
    Bodies w, const Py_ssize_t[:] which, const double[:, :] pose, const double[:, :] turned,
    const double[:, :] height) noexcept
@cython.locals(i=Py_ssize_t, k=Py_ssize_t)
cdef void write_twists(
    Bodies w, const Py_ssize_t[:] which, const double[:, :] twist) noexcept
@cython.locals(i=Py_ssize_t, k=Py_ssize_t, b=Py_ssize_t, cos=double, sin=double)
cdef void write_motion(
    Bodies w, const Py_ssize_t[:] which, const double[:, :] linear,
    const double[:, :] angular) noexcept
cdef void drive(Bodies w, Py_ssize_t b, double ahead, double aside, double turning) noexcept
@cython.locals(i=Py_ssize_t, k=Py_ssize_t, w=Py_ssize_t)
cpdef void rest_joints(
    const Py_ssize_t[:] worlds, double[:, ::1] angles, double[:, ::1] rates,
    double[:, ::1] targets) noexcept
