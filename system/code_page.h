// SPDX-License-Identifier: MIT
// Text in the code pages that systems had before Unicode.
#ifndef SYSTEM_CODE_PAGE_H
#define SYSTEM_CODE_PAGE_H

enum { SYSTEM_CODE_PAGE_UTF8 = 65001 };

/// Converts text from one code page to another; they have the numbers that IBM and Microsoft gave them. The text is to
/// be freed. NULL where the system does not know a code page, the text is not of it, or the other one lacks a
/// character.
char *system_code_page_convert(int from, int to, const char *text);

#endif
