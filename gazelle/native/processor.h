/* What the processor can do, and what the system lets it. */
#ifndef GAZELLE_PROCESSOR_H
#define GAZELLE_PROCESSOR_H

#if (defined(__GNUC__) || defined(__clang__)) && (defined(__x86_64__) || defined(__i386__))
#include <cpuid.h>
/* Not __builtin_cpu_supports, which is always false as Zig links it. */
static int gazelle_has_avx2(void) {
    unsigned a, b, c, d, low, high;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & (1u << 27))) return 0;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    if ((low & 6) != 6 || !__get_cpuid_count(7, 0, &a, &b, &c, &d)) return 0;
    return (b >> 5) & 1;
}
#elif defined(_MSC_VER) && defined(_M_X64)
#include <intrin.h>
static int gazelle_has_avx2(void) {
    int words[4];
    __cpuid(words, 0);
    if (words[0] < 7) return 0;
    __cpuid(words, 1);
    if (!(words[2] & (1 << 27)) || (_xgetbv(0) & 6) != 6) return 0;
    __cpuidex(words, 7, 0);
    return (words[1] >> 5) & 1;
}
#else
static int gazelle_has_avx2(void) { return 0; }
#endif

#endif
