// SPDX-License-Identifier: MIT
// Pictures that follow one another become files while the next ones are drawn: encoded by threads of their own, several
// at once, and added in their order to a file that moves.
#ifndef CLI_FRAME_WRITER_H
#define CLI_FRAME_WRITER_H

#include "moving_write.h"
#include "render_state.h"

struct cli_frame_writer;

/// `moving`: where they all go; NULL: each goes into files of its own. As many threads as the context of `render` has,
/// up to a few. NULL after a report.
struct cli_frame_writer *cli_frame_writer_open(const struct render *render, struct cli_moving *moving);
/// Takes the picture and the paths of `render`, which has neither afterwards, and returns when there is room for the
/// next. False after a failure, which is reported.
bool cli_frame_writer_add(struct cli_frame_writer *writer, struct render *render);
/// Waits until all are written, and frees the writer. False after a failure.
bool cli_frame_writer_close(struct cli_frame_writer *writer);

#endif
