cimport cython

@cython.locals(n=Py_ssize_t, frame=Py_ssize_t, ray=Py_ssize_t, rays=Py_ssize_t, at=Py_ssize_t, x=double, y=double, z=double, w=double, a=double, b=double, c=double, i=double, j=double, k=double, px=double, py=double, pz=double)
cdef void aim(
    const double[:, :, ::1] position, const double[:, :, ::1] quaternion,
    const double[:, :, ::1] origins, const double[:, :, ::1] directions, const double[::1] beside,
    double[:, :, ::1] start, double[:, :, ::1] along) noexcept

@cython.locals(n=Py_ssize_t, ray=Py_ssize_t, out=double)
cdef void settle(
    double[:, ::1] distance, const double[:, :, ::1] normal, const double[:, :, ::1] along,
    const int[:, ::1] geom, const unsigned char[::1] sheet, unsigned char[:, ::1] inside) noexcept
