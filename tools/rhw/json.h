// SPDX-License-Identifier: MIT
// The two things about JSON that printf does not do: strings and numbers that may be infinite.
#ifndef CLI_JSON_H
#define CLI_JSON_H

#include <stdio.h>

/// Quoted and escaped. Bytes that are not UTF-8, which file names may hold, become U+FFFD.
void cli_json_string(FILE *stream, const char *text);
/// Write the fewest digits, 15 or more, that are read as the number again; null when it is not finite.
void cli_json_double(FILE *stream, double number);
/// Nine digits; null when it is not finite, which JSON cannot say.
void cli_json_number(FILE *stream, double number);

#endif
