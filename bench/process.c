// SPDX-License-Identifier: MIT
// See process.h. posix_spawn does not copy the memory of the benchmark, as fork would: the time is the program's own.
#include "process.h"

#include "rhw/rhw.h"

#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static const char program[] = "/proc/self/exe";

bool bench_can_start_itself(void)
{
    return access(program, X_OK) == 0;
}

bool bench_render_process(const char *model, int width, int height, int threads, enum rhw_isa isa)
{
    const char *const folder = getenv("TMPDIR");
    char path[512], size[32], count[16];
    snprintf(path, sizeof path, "%.400s/rhw_bench_%ld.png", folder ? folder : "/tmp", (long)getpid());
    snprintf(size, sizeof size, "%dx%d", width, height);
    snprintf(count, sizeof count, "%d", threads);
    const char *const arguments[] = {
        "rhw",   "render",          model,     "-o", path, "--size", size, "--threads", count,
        "--isa", rhw_isa_name(isa), "--quiet", NULL};
    pid_t child;
    int status = -1;
    const bool ran =
        posix_spawn(&child, program, NULL, NULL, (char *const *)(uintptr_t)arguments, environ) == 0 &&
        waitpid(child, &status, 0) == child;
    unlink(path);
    return ran && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
