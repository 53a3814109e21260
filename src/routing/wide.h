// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Before a function over long rows of numbers: it is compiled for AVX2 too, and which is called is decided when the
/// program starts, by what the processor has. Only where compiler and loader can do that; sanitizers are not ready yet
/// when it is decided.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define EXTERNAL_COMMAND_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define EXTERNAL_COMMAND_WIDE
#endif
