// SPDX-License-Identifier: MIT
// What the program says on stderr: error and warning lines of one form, and on a terminal what it is doing.
#ifndef RHW_MESSAGE_H
#define RHW_MESSAGE_H

/// One line on stderr: "rhw: SUBJECT: CAUSE". Control characters become '?', so it stays one line whatever
/// a file is called. `subject` is a file, an option or a verb; "-" reads as standard output.
void rhw_tool_error(const char *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));
/// The same with "warning: " before the cause.
void rhw_tool_warning(const char *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));

/// Says on a terminal what goes on ("reading", "sponza.gltf") until the next stage, line or
/// rhw_tool_stage_end. Says nothing where stderr is no terminal.
void rhw_tool_stage(const char *work, const char *subject);
void rhw_tool_stage_end(void);

#endif
