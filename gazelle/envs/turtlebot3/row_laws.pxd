cpdef void see(
    const double[:, ::1] ranges, double nearest, double farthest, const double[:, :] pose,
    const double[:, :] goal, float[:, ::1] state, double[:, ::1] found) noexcept
cdef double wave_of(double heading, double index) noexcept nogil
cpdef void find_waves(
    const double[::1] heading, const double[::1] index, double[::1] wave) noexcept
cpdef void judge_all(
    const double[:, ::1] found, const double[::1] angular, double collision, double arrival,
    double near, double penalty, double crash, double prize, double[::1] reward,
    unsigned char[:, ::1] ends) noexcept
