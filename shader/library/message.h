// SPDX-License-Identifier: MIT
// Messages of the public functions, which are one line.
#ifndef SHADER_MESSAGE_H
#define SHADER_MESSAGE_H

// Write a message of RHW_SHADER_MESSAGE bytes, where there is room for one: `message` may be NULL.
void shader_say(char *message, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
