// SPDX-License-Identifier: MIT
// What the program says on stderr: error and warning lines of one form, and on a terminal what it is doing.
#ifndef CLI_MESSAGE_H
#define CLI_MESSAGE_H

/// One line on stderr: "rhw: SUBJECT: CAUSE". Control characters become '?', so it stays one line whatever
/// a file is called. `subject` is a file, an option or a verb; "-" reads as standard output.
void cli_error(const char *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));
/// The same with "warning: " before the cause.
void cli_warning(const char *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));

/// Gives the lines of both to `hear` as well, without "rhw: ", from whatever thread has one; NULL: to nobody.
void cli_message_listen(void (*hear)(void *user, const char *line), void *user);

/// Says on a terminal what goes on ("reading", "sponza.gltf") until the next stage, line or
/// cli_stage_end. Says nothing where stderr is no terminal.
void cli_stage(const char *work, const char *subject);
void cli_stage_end(void);
/// A bar: how many pictures of `count` are done. Stages show nothing until its end.
void cli_progress(const char *subject, int done, int count);
void cli_progress_end(void);

#endif
