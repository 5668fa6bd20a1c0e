// SPDX-License-Identifier: MIT
// See subprocess.h. A command line is one text there, which programs cut by rules of their C library.
#include "subprocess.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

enum { PATH_SIZE = 4096, LINE_SIZE = 32768 };

static struct {
    HANDLE handles[MAXIMUM_WAIT_OBJECTS];
    DWORD count;
} started;

struct line {
    char text[LINE_SIZE];
    size_t length;
    bool is_full;
};

static void put(struct line *line, char c)
{
    line->is_full = line->is_full || line->length + 1 >= LINE_SIZE;
    line->text[line->length] = c;
    line->length += !line->is_full;
}

// Between quotation marks; backslashes before one count double, those elsewhere do not.
static void put_argument(struct line *line, const char *argument)
{
    size_t slashes = 0;
    put(line, '"');
    for (const char *c = argument; *c; c++) {
        for (; *c == '"' && slashes > 0; slashes--) {
            put(line, '\\');
        }
        if (*c == '"') {
            put(line, '\\');
        }
        slashes = *c == '\\' ? slashes + 1 : 0;
        put(line, *c);
    }
    for (; slashes > 0; slashes--) {
        put(line, '\\');
    }
    put(line, '"');
    put(line, ' ');
}

static bool is_missing(DWORD error)
{
    return error == ERROR_FILE_NOT_FOUND || error == ERROR_PATH_NOT_FOUND;
}

// The process, or NULL with errno.
static HANDLE start(const char *program, const char *const *arguments)
{
    struct line *const line = calloc(1, sizeof *line);
    STARTUPINFOA about = {.cb = sizeof about};
    PROCESS_INFORMATION process;
    errno = ENOMEM;
    if (!line) {
        return NULL;
    }
    for (size_t i = 0; arguments[i]; i++) {
        put_argument(line, arguments[i]);
    }
    const bool is_whole = !line->is_full;
    const bool runs =
        is_whole && CreateProcessA(program, line->text, NULL, NULL, TRUE, 0, NULL, NULL, &about, &process);
    free(line);
    if (!runs) {
        errno = !is_whole ? E2BIG : is_missing(GetLastError()) ? ENOENT : EACCES;
        return NULL;
    }
    CloseHandle(process.hThread);
    return process.hProcess;
}

static bool find_program(char path[PATH_SIZE])
{
    const DWORD length = GetModuleFileNameA(NULL, path, PATH_SIZE);
    return length > 0 && length < PATH_SIZE;
}

// What crashed has the number of an exception.
static int take_status(HANDLE process)
{
    DWORD status = 0;
    const bool known = GetExitCodeProcess(process, &status) && status <= 255;
    CloseHandle(process);
    return known ? (int)status : -1;
}

bool system_subprocess_start(int (*run)(int count, char **arguments), int count, char **arguments)
{
    (void)run;
    char path[PATH_SIZE];
    errno = EAGAIN;
    const char **const all =
        started.count < MAXIMUM_WAIT_OBJECTS ? calloc((size_t)count + 2, sizeof *all) : NULL;
    if (!all || !find_program(path)) {
        free(all);
        return false;
    }
    all[0] = path;
    for (int i = 0; i < count; i++) {
        all[i + 1] = arguments[i];
    }
    const HANDLE process = start(path, all);
    free(all);
    if (process) {
        started.handles[started.count++] = process;
    }
    return process != NULL;
}

int system_subprocess_wait(void)
{
    const DWORD which =
        WaitForMultipleObjects(started.count, started.handles, FALSE, INFINITE) - WAIT_OBJECT_0;
    if (which >= started.count) {
        return -1;
    }
    const HANDLE process = started.handles[which];
    started.handles[which] = started.handles[--started.count];
    return take_status(process);
}

bool system_subprocess_can_restart(void)
{
    char path[PATH_SIZE];
    return find_program(path);
}

int system_subprocess_restart(const char *const *arguments)
{
    char path[PATH_SIZE];
    const HANDLE process = find_program(path) ? start(path, arguments) : NULL;
    if (!process) {
        return -1;
    }
    (void)WaitForSingleObject(process, INFINITE);
    return take_status(process);
}

void system_subprocess_become(const char *name, char **arguments)
{
    char path[PATH_SIZE];
    char *const slash = find_program(path) ? strrchr(path, '\\') : NULL;
    HANDLE process = NULL;
    errno = ENOENT;
    if (slash && (size_t)(slash - path) + strlen(name) + sizeof "\\.exe" < PATH_SIZE) {
        strcpy(slash + 1, name);
        strcat(slash, ".exe");
        process = start(path, (const char *const *)arguments);
    }
    if (process) { // Windows replaces no program: this one waits for it
        (void)WaitForSingleObject(process, INFINITE);
        exit(take_status(process));
    }
}

void system_subprocess_set_variable(const char *name, const char *value)
{
    _putenv_s(name, value);
}
