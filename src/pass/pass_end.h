// SPDX-License-Identifier: MIT
// The end of recording, and a run of what was recorded.
#ifndef RHW_PASS_END_H
#define RHW_PASS_END_H

#include "rhw/stats.h"

struct rhw_context;
struct rhw_encoder;
struct rhw_recorded_pass;

// End the recording of a pass. Report what was begun and not ended; `where` is the function that ends the pass. Return
// false if a hook of the program has ended the pass meanwhile.
bool rhw_encoder_end(struct rhw_encoder *encoder, const char *where);

// Run a recorded pass, and answer its queries.
enum rhw_result rhw_recorded_pass_run(struct rhw_context *context, struct rhw_recorded_pass *pass,
                                      struct rhw_stats *stats);
// Report what validation found in a pass that was run with this result. Return the result, or RHW_ERROR_MISUSE where
// the pass ran and was misused, as context->recording says, or was found to be misuse.
enum rhw_result rhw_recorded_pass_tell(struct rhw_context *context, const struct rhw_recorded_pass *pass,
                                       enum rhw_result result);

// Empty the reports on tiles that the program asked for (reports.c).
void rhw_pass_empty_reports(struct rhw_recorded_pass *pass);

// Release items that were destroyed, and memory that was replaced, while a pass needed them, unless a recorder of the
// context records a pass.
void rhw_pass_release_retired(struct rhw_context *context);

#endif
