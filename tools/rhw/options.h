// SPDX-License-Identifier: MIT
// The command line of every verb: one table of options feeds getopt_long and --help alike, so that neither
// can lag behind the other, and one set of value parsers and error lines makes all verbs speak alike.
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "message.h"

#include <getopt.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Exit statuses of the program. A verb's entry point returns one of them.
enum cli_status {
    CLI_OK = 0,
    CLI_FAILED = 1, ///< the work failed, or `compare` found a difference
    CLI_USAGE = 2   ///< the command line is wrong; nothing was done
};

/// One option. `--help` and `-h` are added by the parser.
struct cli_option {
    const char *name;     ///< long name without dashes
    int id;               ///< a letter: the short form too; 256 or more: long form only
    const char *argument; ///< what --help calls the argument; NULL: none; "[NAME]": optional, as --name=NAME
    /// One or more lines, separated by \n. It is NULL for an option that the program passes to itself: --help leaves
    /// that out, and it is known when written in full.
    const char *help;
};

/// One verb: its name on the command line and all that --help says about it.
struct cli_verb {
    const char *name;
    const char *operands; ///< what follows the options, "MODEL"
    const char *summary;  ///< one sentence
    const struct cli_option *options;
    int option_count;
    void (*print_table)(void); ///< prints what stands between the options and the notes; NULL: nothing does
    const char *notes;         ///< paragraphs after the options, or NULL
};

enum { CLI_OPTIONS_MAX = 80 };

/// State of a walk over the options; fields below the line belong to the parser.
struct cli_parser {
    const char *argument; ///< of the option that was just returned, or NULL
    int status;           ///< what to return after CLI_OPTION_STOP
    char **operands;      ///< after CLI_OPTION_END: what stood between the options
    int operand_count;
    const struct cli_verb *helped; ///< what --help prints; the start makes it the verb
    // ---
    const struct cli_verb *verb;
    int argc;
    char **argv;
    struct option longs[CLI_OPTIONS_MAX + 2];
    char shorts[2 * CLI_OPTIONS_MAX + 4];
};

enum {
    CLI_OPTION_END = 0,  ///< all options seen
    CLI_OPTION_STOP = -1 ///< help was printed or a mistake was reported: return parser.status
};

/// Starts a walk. argv[0] is the verb's name.
void cli_parser_start(struct cli_parser *parser, const struct cli_verb *verb, int argc, char **argv);
/// The id of the next option, or END or STOP. `verb` must outlive the walk.
int cli_parser_next(struct cli_parser *parser);
/// Reports a wrong number of operands. True when it is within `least`..`most`.
bool cli_parser_operands(const struct cli_parser *parser, int least, int most);
/// Prints what `--help` prints, to stdout.
void cli_print_help(const struct cli_verb *verb);

/// Value parsers. The whole text must be the value; on failure nothing is stored and nothing printed.
bool cli_parse_int(const char *text, int least, int most, int *value);
/// Finite numbers only.
bool cli_parse_float(const char *text, float *value);
/// `least`..`most` (16 at most) finite numbers separated by commas; stores how many there are.
bool cli_parse_numbers(const char *text, int least, int most, double *values, int *count);
/// "WxH", each 1..RHW_MAX_TARGET_SIZE; "N" for a square.
bool cli_parse_size(const char *text, int *width, int *height);
/// "rrggbb" or "rgb" in hexadecimal, with or without a '#' in front, or one of CSS's better
/// known names.
bool cli_parse_color(const char *text, uint8_t color[3]);
/// The index of `text` among `count` names, or -1.
int cli_parse_name(const char *text, const char *const *names, int count);

/// The position of `argument` among `names`; −1 after a line that lists them.
int cli_choose(const char *option, const char *argument, const char *const *names, int count);

#endif
