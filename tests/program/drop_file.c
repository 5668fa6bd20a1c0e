// SPDX-License-Identifier: MIT
// Drops a file on a window of X11, or a text, as a file manager does (XDND, version 5), and waits until it is taken.
// usage: drop_file WINDOW text/uri-list|text/plain DATA
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <X11/Xatom.h>
#include <X11/Xlib.h>

enum { PATIENCE_SECONDS = 60, VERSION = 5 };

static Display *display;
static Window source, target;

static Atom atom(const char *name)
{
    return XInternAtom(display, name, False);
}

static void send(const char *type, long first, long second, long third, long fourth)
{
    XEvent event = {.xclient = {.type = ClientMessage,
                                .display = display,
                                .window = target,
                                .message_type = atom(type),
                                .format = 32,
                                .data.l = {(long)source, first, second, third, fourth}}};
    XSendEvent(display, target, False, NoEventMask, &event);
    XFlush(display);
}

// Gives the data to whoever asks, until the target sends that message.
static void serve_until(const char *type, const char *data)
{
    for (;;) {
        XEvent event;
        XNextEvent(display, &event);
        if (event.type == ClientMessage && event.xclient.message_type == atom(type)) {
            return;
        }
        if (event.type == SelectionRequest) {
            const XSelectionRequestEvent *const asked = &event.xselectionrequest;
            XChangeProperty(display, asked->requestor, asked->property, asked->target, 8, PropModeReplace,
                            (const unsigned char *)data, (int)strlen(data));
            XEvent answer = {.xselection = {.type = SelectionNotify,
                                            .display = display,
                                            .requestor = asked->requestor,
                                            .selection = asked->selection,
                                            .target = asked->target,
                                            .property = asked->property,
                                            .time = asked->time}};
            XSendEvent(display, asked->requestor, False, NoEventMask, &answer);
            XFlush(display);
        }
    }
}

int main(int argc, char **argv)
{
    display = argc == 4 ? XOpenDisplay(NULL) : NULL;
    if (!display) {
        fprintf(stderr, "usage: drop_file WINDOW text/uri-list|text/plain DATA, on a display\n");
        return 1;
    }
    alarm(PATIENCE_SECONDS); // who does not answer is killed by it
    target = strtoul(argv[1], NULL, 0);
    source = XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display, atom("XdndSelection"), source, CurrentTime);
    send("XdndEnter", VERSION << 24, (long)atom(argv[2]), 0, 0);
    send("XdndPosition", 0, 10 << 16 | 10, CurrentTime, (long)atom("XdndActionCopy"));
    serve_until("XdndStatus", argv[3]);
    send("XdndDrop", 0, CurrentTime, 0, 0);
    serve_until("XdndFinished", argv[3]);
    XCloseDisplay(display);
    return 0;
}
