cdef void find_distances(
    const double[:, :] position, const double[:, :] goal, double[::1] found) noexcept
cdef void find_headings(
    const double[:, :] position, const double[:] yaw, const double[:, :] goal,
    double[::1] found) noexcept
cdef double distance_of(double x, double y) noexcept nogil
cdef double heading_of(double x, double y, double yaw) noexcept nogil
