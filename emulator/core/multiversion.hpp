#pragma once

// GONIO_CLONES before a function builds it for several instruction sets; the best one is chosen
// when the program starts. Sanitizers start later than that choice, so they get the plain build.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GONIO_CLONES [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")]]
#else
#define GONIO_CLONES
#endif
