// SPDX-License-Identifier: MIT
// Entry points of the verbs. argv[0] is the verb's name; the result is an rhw_tool_status.
#ifndef RHW_VERBS_H
#define RHW_VERBS_H

int rhw_tool_render(int argc, char **argv);
int rhw_tool_compare(int argc, char **argv);
int rhw_tool_info(int argc, char **argv);
int rhw_tool_bench(int argc, char **argv);

#endif
