# What joint_math.py says, for compiled modules.

from libc.math cimport isfinite


cdef inline double clamp(double value, double low, double high) noexcept nogil:
    value = low if low > value else value
    return high if high < value else value


cdef inline double pid_output(
    double error, double whole, double rate, double p, double i, double d, double least, double most
) noexcept nogil:
    return p * error + clamp(i * whole, least, most) + d * rate


cdef inline double effort_within(
    double effort, double position, double velocity,
    double lower, double upper, double fastest, double strongest,
) noexcept nogil:
    cdef double low, high
    low = 0.0 if velocity < -fastest else -strongest
    low = 0.0 if position < lower else low
    high = 0.0 if velocity > fastest else strongest
    high = 0.0 if position > upper else high
    return clamp(effort, low, high)


cdef inline double finite(double value) noexcept nogil:
    return value if isfinite(value) else 0.0
