/* What the processor can do, and what the system lets it. */
#ifndef GAZELLE_PROCESSOR_H
#define GAZELLE_PROCESSOR_H

#if (defined(__GNUC__) || defined(__clang__)) && (defined(__x86_64__) || defined(__i386__))
static int gazelle_has_avx2(void) {
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") != 0;
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
