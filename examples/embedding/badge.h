// SPDX-License-Identifier: MIT
// A library of your own that draws with rhw inside and shows nothing of it: one function.
#ifndef BADGE_H
#define BADGE_H

// Draws a badge of size × size pixels, 4 bytes each: red, green, blue, alpha. 0, or −1 where memory is short.
int badge_draw(unsigned char *pixels, int size);

#endif
