cimport cython

@cython.locals(i=Py_ssize_t, x=double, y=double, z=double, w=double)
cpdef void find_headings(
    const double[:, :] quaternions, double[:] ahead, double[:] aside) noexcept
@cython.locals(i=Py_ssize_t, k=Py_ssize_t, size=double, largest=double)
cpdef bint are_orientations(const double[:, :] quaternions) noexcept
@cython.locals(i=Py_ssize_t, k=Py_ssize_t)
cpdef bint are_within(const double[:, :] values, double most) noexcept
