#pragma once

// OpenBLAS 0.3.21 takes a buffer of 128 MB of address space for each thread: one when it is loaded, another when
// the thread first multiplies. Where ulimit -v refuses it, it asks again for ever (blas_memory_alloc in its
// memory.c). Hence all of them are counted before it is loaded, and taken before anything else takes their room.
namespace mill {
/// Counts the buffers of a limited address space, with the arguments of main().  A program calls it before the
/// constructors of its libraries, OpenBLAS's among them (app/main.cpp): nothing of C++ may be used in it.  Where
/// not all of them fit it starts the program again with fewer threads, or ends it.
void check_address_space(int n_arguments, char **arguments, char **environment);

/// Threads, at most `wanted`, whose buffers fit into the address space that is allowed. What leaves no room for
/// one thread does not get this far: the program then ends with exit code 3 before any library begins.
int threads_that_fit(int wanted);

/// Threads, at most `wanted`, that the system lets run at once (ulimit -u, the limit of a container): tried out,
/// since libgomp ends the program where it cannot start one.
int threads_that_start(int wanted);

/// Takes the buffers of that many threads now, and with them room for the stack, when the address space is
/// limited.
void reserve_address_space(int threads);
}  // namespace mill
