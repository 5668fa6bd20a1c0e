// SPDX-License-Identifier: MIT
// Entry points of the verbs. argv[0] is the verb's name; the result is an cli_status.
#ifndef CLI_VERBS_H
#define CLI_VERBS_H

int cli_render(int argc, char **argv);
int cli_compare(int argc, char **argv);
int cli_thumbs(int argc, char **argv);
int cli_view(int argc, char **argv);
int cli_info(int argc, char **argv);
int cli_explain(int argc, char **argv);
int cli_shader(int argc, char **argv);
int cli_bench(int argc, char **argv);

#endif
