// SPDX-License-Identifier: MIT
// The command line of every verb: one table of options feeds getopt_long and --help alike, so that neither
// can lag behind the other, and one set of value parsers and error lines makes all verbs speak alike.
#ifndef RHW_OPTIONS_H
#define RHW_OPTIONS_H

#include "message.h"

#include <getopt.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Exit statuses of the program. A verb's entry point returns one of them.
enum rhw_tool_status {
    RHW_TOOL_OK = 0,
    RHW_TOOL_FAILED = 1, ///< the work failed, or `compare` found a difference
    RHW_TOOL_USAGE = 2   ///< the command line is wrong; nothing was done
};

/// One option. `--help` and `-h` are added by the parser.
struct rhw_tool_option {
    const char *name;     ///< long name without dashes
    int id;               ///< a letter: the short form too; 256 or more: long form only
    const char *argument; ///< what --help calls the argument; NULL: none; "[NAME]": optional, as --name=NAME
    const char *help;     ///< one or more lines, separated by \n
};

/// One verb: its name on the command line and all that --help says about it.
struct rhw_tool_verb {
    const char *name;
    const char *operands; ///< what follows the options, "MODEL"
    const char *summary;  ///< one sentence
    const struct rhw_tool_option *options;
    int option_count;
    const char *notes; ///< paragraphs after the options, or NULL
};

enum { RHW_TOOL_OPTIONS_MAX = 40 };

/// State of a walk over the options; fields below the line belong to the parser.
struct rhw_tool_parser {
    const char *argument; ///< of the option that was just returned, or NULL
    int status;           ///< what to return after RHW_TOOL_OPTION_STOP
    char **operands;      ///< after RHW_TOOL_OPTION_END: what stood between the options
    int operand_count;
    // ---
    const struct rhw_tool_verb *verb;
    int argc;
    char **argv;
    struct option longs[RHW_TOOL_OPTIONS_MAX + 2];
    char shorts[2 * RHW_TOOL_OPTIONS_MAX + 4];
};

enum {
    RHW_TOOL_OPTION_END = 0,  ///< all options seen
    RHW_TOOL_OPTION_STOP = -1 ///< help was printed or a mistake was reported: return parser.status
};

/// Starts a walk. argv[0] is the verb's name.
void rhw_tool_parser_start(struct rhw_tool_parser *parser, const struct rhw_tool_verb *verb, int argc,
                           char **argv);
/// The id of the next option, or END or STOP. `verb` must outlive the walk.
int rhw_tool_parser_next(struct rhw_tool_parser *parser);
/// Reports a wrong number of operands. True when it is within `least`..`most`.
bool rhw_tool_parser_operands(const struct rhw_tool_parser *parser, int least, int most);
/// Prints what `--help` prints, to stdout.
void rhw_tool_print_help(const struct rhw_tool_verb *verb);

/// Value parsers. The whole text must be the value; on failure nothing is stored and nothing printed.
bool rhw_tool_parse_int(const char *text, int least, int most, int *value);
/// Finite numbers only.
bool rhw_tool_parse_float(const char *text, float *value);
/// Exactly `count` numbers separated by commas.
bool rhw_tool_parse_floats(const char *text, int count, float *values);
/// "WxH", each 1..RHW_MAX_TARGET_SIZE.
bool rhw_tool_parse_size(const char *text, int *width, int *height);
/// "rrggbb" or "rgb" in hexadecimal, with or without a '#' in front, or "black", "grey", "white".
bool rhw_tool_parse_color(const char *text, uint8_t color[3]);
/// The index of `text` among `count` names, or -1.
int rhw_tool_parse_name(const char *text, const char *const *names, int count);

#endif
