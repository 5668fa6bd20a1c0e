// SPDX-License-Identifier: MIT
// The part of rhw explain that opens no file, which the WebAssembly module shares: what can be asked for, and the
// draw that answers.
#ifndef CLI_EXPLAIN_DRAW_H
#define CLI_EXPLAIN_DRAW_H

#include "explain_write.h"
#include "render_state.h"

/// False after a message: the job's pictures have no such sample, or no one pass whose history could be told.
bool cli_explain_check(const struct cli_render_job *job, int x, int y, int sample);
/// Draws the view of a scene that is open and keeps the history of a sample. Reports failure, which leaves nothing;
/// else free the history when the explanation, which points to it and into `render`, has been said.
bool cli_explain_draw(struct render *render, int x, int y, int sample, struct cli_history *history,
                      struct cli_explanation *explanation);

#endif
