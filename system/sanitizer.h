// SPDX-License-Identifier: MIT
// Whether a sanitizer is built in. Their shadow memory takes terabytes of address space, which no limit may cut.
#ifndef SYSTEM_SANITIZER_H
#define SYSTEM_SANITIZER_H

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SYSTEM_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define SYSTEM_SANITIZED 1
#endif
#endif
#ifndef SYSTEM_SANITIZED
#define SYSTEM_SANITIZED 0
#endif

#endif
