// SPDX-License-Identifier: MIT
// The program: picks the verb, and sees to it that output that could not be written is an error.
#include "options.h"
#include "output_file.h"
#include "rhw/base.h"
#include "streams.h"
#include "verbs.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name, *operands, *summary;
    int (*run)(int argc, char **argv);
} verbs[] = {
    {"render", "MODEL [-o OUT]", "draw a model file and write the picture", cli_render},
    {"thumbs", "DIR -o OUT", "draw a small picture of every model in a folder", cli_thumbs},
    {"compare", "A B", "differences of two pictures, in numbers and as a picture", cli_compare},
    {"explain", "MODEL --at X,Y", "how a pixel of the picture got its value, step by step", cli_explain},
    {"view", "MODEL", "show a model in a window", cli_view},
    {"info", "MODEL", "what is in a model file", cli_info},
    {"shader", "FILE...", "compile, check, show and run shaders", cli_shader},
    {"bench", "", "time scenes, beside another renderer where there is one", cli_bench},
};

enum { VERB_COUNT = sizeof verbs / sizeof *verbs };

static void print_program_help(void)
{
    printf("Usage: rhw VERB ... [option...]\n"
           "rhw %s, a 3D renderer for the CPU: exact, the same bytes on every machine.\n\n",
           rhw_version());
    for (int i = 0; i < VERB_COUNT; i++) {
        printf("  rhw %-7s %-15s %s\n", verbs[i].name, verbs[i].operands, verbs[i].summary);
    }
    printf("\n  help [VERB], --help      print this, or what 'rhw VERB --help' prints, and exit\n"
           "  --version                print the version and exit\n\n"
           "Exit status: 0, 1 when the work failed, 2 for a wrong command line.\n");
}

// −1 after a message.
static int find_verb(const char *word)
{
    for (int i = 0; i < VERB_COUNT; i++) {
        if (strcmp(word, verbs[i].name) == 0) {
            return i;
        }
    }
    cli_error(word, "no such %s; see 'rhw --help'", word[0] == '-' ? "option" : "verb");
    return -1;
}

static bool is_help(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0;
}

// help VERB
static int print_verb_help(int argc, char **argv)
{
    static char option[] = "--help";
    if (argc > 2) {
        cli_error(argv[2], "one argument too many; see 'rhw --help'");
        return CLI_USAGE;
    }
    const int verb = find_verb(argv[1]);
    if (verb < 0) {
        return CLI_USAGE;
    }
    return verbs[verb].run(2, (char *[]){argv[1], option, NULL});
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        fputs("rhw: no verb given; see 'rhw --help'\n", stderr);
        return CLI_USAGE;
    }
    const char *word = argv[1];
    if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0) {
        printf("rhw %s\n", rhw_version());
        return CLI_OK;
    }
    if (strcmp(word, "help") == 0 && argc > 2 && !is_help(argv[2])) {
        return print_verb_help(argc - 1, argv + 1);
    }
    if (is_help(word)) {
        print_program_help();
        return CLI_OK;
    }
    // A model by itself is drawn.
    if (word[0] != '-' && (strchr(word, '.') || strchr(word, '/'))) {
        return cli_render(argc, argv);
    }
    const int verb = find_verb(word);
    return verb < 0 ? CLI_USAGE : verbs[verb].run(argc - 1, argv + 1);
}

int main(int argc, char **argv)
{
    // All that help says fits: what cannot be written is told by the one flush below, which knows why.
    static char buffer[1 << 16];
    system_streams_start(argc, argv);
    setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
    cli_output_files_guard();
    const int status = run(argc, argv);
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) {
        return status;
    }
    cli_error("-", "cannot be written: %s", strerror(errno ? errno : EIO));
    return CLI_FAILED;
}
