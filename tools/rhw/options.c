// SPDX-License-Identifier: MIT
// Option walk, help text and value parsers; see options.h. getopt_long does the parsing, with
// its own messages switched off because they do not fit the one form of error line this program has.
#include "options.h"

#include "rhw/types.h"

#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    LETTERS_END = 256, // ids below are letters
    HELP_ID = 'h',
    HELP_COLUMN = 29 // where explanations start
};

static bool is_optional(const struct cli_option *option)
{
    return option->argument && option->argument[0] == '[';
}

static void print_option(const struct cli_option *option)
{
    char left[96];
    const char letter[] = {'-', (char)option->id, ',', ' ', 0};
    const char *separator = !option->argument ? "" : is_optional(option) ? "[=" : " ";
    snprintf(left, sizeof left, "  %s--%s%s%s", option->id < LETTERS_END ? letter : "    ", option->name,
             separator, option->argument ? option->argument + is_optional(option) : "");
    int column = printf("%s", left);
    for (const char *line = option->help; line; column = 0) {
        if (column >= HELP_COLUMN - 1) {
            putchar('\n');
            column = 0;
        }
        const char *end = strchr(line, '\n');
        const int length = end ? (int)(end - line) : (int)strlen(line);
        printf("%*s%.*s\n", HELP_COLUMN - column, "", length, line);
        line = end ? end + 1 : NULL;
    }
}

// How many long options begin as a word does.
static int count_matches(const struct cli_parser *parser, const char *word, size_t length)
{
    int count = 0;
    for (int i = 0; parser->longs[i].name; i++) {
        count += strncmp(parser->longs[i].name, word, length) == 0;
    }
    return count;
}

// Whether what getopt complains of is a letter: a long option that is known gives its letter too.
static bool is_letter(const struct cli_parser *parser, const char *word)
{
    bool is_long = false;
    for (int i = 0; parser->longs[i].name && strncmp(word, "--", 2) == 0; i++) {
        is_long = is_long || (parser->longs[i].val == optopt &&
                              strncmp(parser->longs[i].name, word + 2, strcspn(word + 2, "=")) == 0);
    }
    return optopt && optopt < LETTERS_END && !is_long;
}

// Whether an unknown letter stands in the name of a file that begins with a dash; getopt may not be past it.
static bool report_file(const struct cli_parser *parser, const char *name)
{
    for (int i = optind - 1; i <= optind && i < parser->argc; i++) {
        const char *const word = parser->argv[i];
        if (word[0] == '-' && strchr(word, optopt) && access(word, F_OK) == 0) {
            cli_error(name, "no such option; the file %s is to be named ./%s", word, word);
            return true;
        }
    }
    return false;
}

// The word the user typed for a long option, without its value; getopt leaves only its place.
static void report_bad_option(const struct cli_parser *parser, int kind)
{
    char name[128];
    const char *word = parser->argv[optind - 1], *cause = "no such option";
    const bool short_form = is_letter(parser, word);
    if (short_form) {
        snprintf(name, sizeof name, "-%c", optopt);
    } else {
        snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
    }
    if (kind == ':') {
        cause = "needs an argument";
    } else if (!short_form && optopt != 0 && strchr(word, '=')) {
        cause = "takes no argument";
    } else if (short_form && report_file(parser, name)) {
        return;
    } else if (!short_form && count_matches(parser, name + 2, strlen(name + 2)) > 1) {
        cause = "more than one option begins so";
    }
    cli_error(name, "%s; see 'rhw %s --help'", cause, parser->verb->name);
}

// One that --help does not show is there for who writes all of it, so that it makes no beginning of another ambiguous.
static bool is_asked_for(const struct cli_option *option, int argc, char **argv)
{
    const size_t length = strlen(option->name);
    bool asked = option->help != NULL;
    for (int i = 1; i < argc && !asked; i++) {
        asked = strncmp(argv[i], "--", 2) == 0 && strncmp(argv[i] + 2, option->name, length) == 0 &&
                (argv[i][length + 2] == '\0' || argv[i][length + 2] == '=');
    }
    return asked;
}

void cli_parser_start(struct cli_parser *parser, const struct cli_verb *verb, int argc, char **argv)
{
    *parser = (struct cli_parser){.helped = verb, .verb = verb, .argc = argc, .argv = argv};
    char *letter = parser->shorts;
    *letter++ = ':'; // tells a missing argument from an unknown option
    const int count = verb->option_count < CLI_OPTIONS_MAX ? verb->option_count : CLI_OPTIONS_MAX;
    int known = 0;
    for (int i = 0; i < count; i++) {
        const struct cli_option *option = &verb->options[i];
        if (!is_asked_for(option, argc, argv)) {
            continue;
        }
        const int argument = !option->argument     ? no_argument
                             : is_optional(option) ? optional_argument
                                                   : required_argument;
        parser->longs[known++] =
            (struct option){.name = option->name, .has_arg = argument, .val = option->id};
        if (option->id < LETTERS_END) {
            *letter++ = (char)option->id;
            if (argument == required_argument) {
                *letter++ = ':';
            }
        }
    }
    *letter = HELP_ID;
    parser->longs[known] = (struct option){.name = "help", .has_arg = no_argument, .val = HELP_ID};
    optind = 1;
    opterr = 0;
}

int cli_parser_next(struct cli_parser *parser)
{
    const int id = getopt_long(parser->argc, parser->argv, parser->shorts, parser->longs, NULL);
    parser->argument = optarg;
    if (id == -1) {
        parser->operands = parser->argv + optind;
        parser->operand_count = parser->argc - optind;
        return CLI_OPTION_END;
    }
    if (id == HELP_ID) {
        cli_print_help(parser->helped);
        parser->status = CLI_OK;
        return CLI_OPTION_STOP;
    }
    if (id == '?' || id == ':') {
        report_bad_option(parser, id);
        parser->status = CLI_USAGE;
        return CLI_OPTION_STOP;
    }
    return id;
}

bool cli_parser_operands(const struct cli_parser *parser, int least, int most)
{
    const struct cli_verb *verb = parser->verb;
    if (parser->operand_count < least) {
        cli_error(verb->name, "expected %s; see 'rhw %s --help'", verb->operands, verb->name);
        return false;
    }
    if (parser->operand_count > most) {
        cli_error(parser->operands[most], "one argument too many; see 'rhw %s --help'", verb->name);
        return false;
    }
    return true;
}

void cli_print_help(const struct cli_verb *verb)
{
    printf("Usage: rhw %s%s%s [option...]\n%s\n\n", verb->name, verb->operands[0] ? " " : "", verb->operands,
           verb->summary);
    for (int i = 0; i < verb->option_count; i++) {
        if (verb->options[i].help) {
            print_option(&verb->options[i]);
        }
    }
    print_option(&(struct cli_option){"help", HELP_ID, NULL, "print this and exit"});
    if (verb->print_table) {
        putchar('\n');
        verb->print_table();
        printf("%s\n", verb->notes);
    } else if (verb->notes) {
        printf("\n%s\n", verb->notes);
    }
}

bool cli_parse_int(const char *text, int least, int most, int *value)
{
    char *end;
    errno = 0;
    const long number = strtol(text, &end, 10);
    if (end == text || isspace((unsigned char)*text) || *end || errno || number < least || number > most) {
        return false;
    }
    *value = (int)number;
    return true;
}

bool cli_parse_float(const char *text, float *value)
{
    char *end;
    const float number = strtof(text, &end);
    if (end == text || *end || !isfinite(number)) {
        return false;
    }
    *value = number;
    return true;
}

bool cli_parse_numbers(const char *text, int least, int most, double *values, int *count)
{
    double parsed[16];
    int found = 0;
    bool more = most <= 16;
    while (more) {
        char *end;
        if (found == most) {
            return false;
        }
        parsed[found] = strtod(text, &end);
        if (end == text || !isfinite(parsed[found]) || (*end != ',' && *end != '\0')) {
            return false;
        }
        found++;
        more = *end == ',';
        text = end + 1;
    }
    if (found < least) {
        return false;
    }
    memcpy(values, parsed, (size_t)found * sizeof *values);
    *count = found;
    return true;
}

bool cli_parse_size(const char *text, int *width, int *height)
{
    const char *separator = strchr(text, 'x');
    char first[16];
    if (!separator && cli_parse_int(text, 1, RHW_MAX_TARGET_SIZE, width)) {
        *height = *width;
        return true;
    }
    if (!separator || (size_t)(separator - text) >= sizeof first) {
        return false;
    }
    memcpy(first, text, (size_t)(separator - text));
    first[separator - text] = '\0';
    int parsed[2];
    if (!cli_parse_int(first, 1, RHW_MAX_TARGET_SIZE, &parsed[0]) ||
        !cli_parse_int(separator + 1, 1, RHW_MAX_TARGET_SIZE, &parsed[1])) {
        return false;
    }
    *width = parsed[0];
    *height = parsed[1];
    return true;
}

static int hex_digit(char c)
{
    const char *digits = "0123456789abcdef";
    const char *found = c ? strchr(digits, tolower((unsigned char)c)) : NULL;
    return found ? (int)(found - digits) : -1;
}

bool cli_parse_color(const char *text, uint8_t color[3])
{
    static const struct {
        const char *name, *digits;
    } named[] = {{"black", "000000"},  {"grey", "808080"},    {"gray", "808080"},    {"white", "ffffff"},
                 {"silver", "c0c0c0"}, {"red", "ff0000"},     {"maroon", "800000"},  {"orange", "ffa500"},
                 {"yellow", "ffff00"}, {"olive", "808000"},   {"lime", "00ff00"},    {"green", "008000"},
                 {"cyan", "00ffff"},   {"aqua", "00ffff"},    {"teal", "008080"},    {"blue", "0000ff"},
                 {"navy", "000080"},   {"magenta", "ff00ff"}, {"fuchsia", "ff00ff"}, {"purple", "800080"},
                 {"pink", "ffc0cb"},   {"brown", "a52a2a"},   {"beige", "f5f5dc"},   {"skyblue", "87ceeb"}};
    for (size_t i = 0; i < sizeof named / sizeof *named; i++) {
        if (strcmp(text, named[i].name) == 0) {
            text = named[i].digits;
        }
    }
    text += text[0] == '#';
    const size_t length = strlen(text);
    if (length != 3 && length != 6) {
        return false;
    }
    uint8_t parsed[3];
    for (size_t i = 0; i < 3; i++) {
        const int high = hex_digit(text[i * length / 3]);
        const int low = hex_digit(text[i * length / 3 + length / 3 - 1]);
        if (high < 0 || low < 0) {
            return false;
        }
        parsed[i] = (uint8_t)(high * 16 + low);
    }
    memcpy(color, parsed, sizeof parsed);
    return true;
}

int cli_parse_name(const char *text, const char *const *names, int count)
{
    for (int i = 0; i < count; i++) {
        if (strcmp(text, names[i]) == 0) {
            return i;
        }
    }
    return -1;
}

int cli_choose(const char *option, const char *argument, const char *const *names, int count)
{
    const int found = cli_parse_name(argument, names, count);
    if (found >= 0) {
        return found;
    }
    char list[128] = "";
    for (int i = 0; i < count; i++) {
        strcat(list, i == 0 ? "" : i + 1 < count ? ", " : " or ");
        strcat(list, names[i]);
    }
    cli_error(option, "'%s' is not %s", argument, list);
    return -1;
}
