// SPDX-License-Identifier: MIT
// See ending.h. The system calls its handler in a thread of its own; the deadline is a thread, too.
#include "ending.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <stdatomic.h>
#include <string.h>

enum { PATIENCE_MS = 1000 };

static struct {
    void (*clean)(void);
    const char *late;
    DWORD milliseconds;
    _Atomic int holders;
    _Atomic bool ends;
} ending;

static void clean_up(void)
{
    if (!ending.clean) {
        return;
    }
    ending.ends = true; // a thread that holds counts itself first and looks at this then
    for (int i = 0; i < PATIENCE_MS && ending.holders > 0; i++) {
        Sleep(1);
    }
    ending.clean();
}

void system_ending_hold(void)
{
    ending.holders++;
    if (ending.ends) {
        ending.holders--;
        Sleep(INFINITE);
    }
}

bool system_ending_began(void)
{
    return ending.ends;
}

void system_ending_release(void)
{
    ending.holders--;
}

static BOOL WINAPI hear(DWORD event)
{
    (void)event;
    clean_up();
    return FALSE; // the next handler ends the program
}

void system_ending_guard(void (*clean)(void))
{
    ending.clean = clean;
    (void)SetConsoleCtrlHandler(hear, TRUE);
}

static DWORD WINAPI wait_for_deadline(void *user)
{
    (void)user;
    DWORD written;
    Sleep(ending.milliseconds);
    clean_up();
    (void)WriteFile(GetStdHandle(STD_ERROR_HANDLE), ending.late, (DWORD)strlen(ending.late), &written, NULL);
    ExitProcess(1);
}

void system_ending_deadline(double seconds, const char *line)
{
    ending.late = line;
    ending.milliseconds = (DWORD)(seconds * 1e3);
    HANDLE const thread = CreateThread(NULL, 0, wait_for_deadline, NULL, 0, NULL);
    if (thread) {
        CloseHandle(thread);
    }
}
