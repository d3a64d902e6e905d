/* What Python's own pyconfig.h for Windows on x86-64 says, as far as the limited API reads it.
 *
 * Headers of a Python on another system serve for Windows with this file in place of theirs.
 */
#ifndef Py_CONFIG_H
#define Py_CONFIG_H

#define MS_WIN32 1
#define MS_WIN64 1
#define MS_WINDOWS 1
#define NT_THREADS 1
#define WITH_THREAD 1

/* Names come from python3.dll. */
#define HAVE_DECLSPEC_DLL 1
#define Py_ENABLE_SHARED 1

#define HAVE_ERRNO_H 1
#define HAVE_SSIZE_T 1
#define HAVE_STDDEF_H 1
#define HAVE_SYS_STAT_H 1
#define HAVE_SYS_TYPES_H 1
#define HAVE_WCHAR_H 1

#define ALIGNOF_SIZE_T 8
#define SIZEOF_DOUBLE 8
#define SIZEOF_FLOAT 4
#define SIZEOF_INT 4
#define SIZEOF_LONG 4
#define SIZEOF_LONG_LONG 8
#define SIZEOF_OFF_T 4
#define SIZEOF_SHORT 2
#define SIZEOF_SIZE_T 8
#define SIZEOF_TIME_T 8
#define SIZEOF_VOID_P 8
#define SIZEOF_WCHAR_T 2

#endif
