// SPDX-License-Identifier: MIT
// one_at_a_time.h as a compiler without lanes makes it.
#ifndef TEST_NO_LANES_H
#define TEST_NO_LANES_H

#include <rhw/types.h>

float no_lanes_math(int number, float a, float b);
rhw_vertex1_function no_lanes_vertex;
rhw_fragment1_function no_lanes_fragment;

#endif
