/* What threads of a run share: a counter that hands out work, and a barrier.
 *
 * A barrier is waited for by spinning, as the others are about as far: a system call would take
 * longer than most updates. Who waits long lets other programs run.
 */
#ifndef GAZELLE_THREADS_H
#define GAZELLE_THREADS_H

#if defined(_MSC_VER)
#include <intrin.h>
#include <windows.h>
#define gazelle_add(place, amount) _InterlockedExchangeAdd64((volatile __int64 *)(place), (amount))
#define gazelle_read(place) _InterlockedExchangeAdd64((volatile __int64 *)(place), 0)
#define gazelle_write(place, value) _InterlockedExchange64((volatile __int64 *)(place), (value))
#define gazelle_pause() YieldProcessor()
#define gazelle_yield() SwitchToThread()
#else
#define gazelle_add(place, amount) __atomic_fetch_add((place), (amount), __ATOMIC_ACQ_REL)
#define gazelle_read(place) __atomic_load_n((place), __ATOMIC_ACQUIRE)
#define gazelle_write(place, value) __atomic_store_n((place), (value), __ATOMIC_RELEASE)
#if defined(__x86_64__) || defined(__i386__)
#define gazelle_pause() __builtin_ia32_pause()
#elif defined(__aarch64__)
#define gazelle_pause() __asm__ __volatile__("yield")
#else
#define gazelle_pause() ((void)0)
#endif
#if defined(_WIN32)
#include <windows.h>
#define gazelle_yield() SwitchToThread()
#else
#include <sched.h>
#define gazelle_yield() sched_yield()
#endif
#endif

enum { GAZELLE_SPINS = 2000 };

/* What the counter was before an amount was added. */
static inline long long gazelle_fetch_add(long long *counter, long long amount) {
    return gazelle_add(counter, amount);
}

/* Return when all threads of a number have called it; places[0] and [1] are 0 at first. */
static inline void gazelle_wait_for_all(long long *places, long long threads) {
    const long long round = gazelle_read(&places[1]);
    if (gazelle_add(&places[0], 1) == threads - 1) {
        gazelle_write(&places[0], 0);
        gazelle_add(&places[1], 1);
        return;
    }
    for (int spins = 0; gazelle_read(&places[1]) == round; spins++) {
        if (spins < GAZELLE_SPINS) gazelle_pause();
        else gazelle_yield();
    }
}

#endif
