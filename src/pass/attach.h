// SPDX-License-Identifier: MIT
// The attachments of a pass.
#ifndef RHW_PASS_ATTACH_H
#define RHW_PASS_ATTACH_H

#include "rhw/pass_def.h"

struct rhw_encoder;

// Sets what the pass draws into; width and height too where they are 0. Misuse is reported as that of rhw_pass_begin.
enum rhw_result rhw_pass_attach(struct rhw_encoder *encoder, const struct rhw_pass_def *def);

// Whether a pass has any of colour, as they may be left out.
bool rhw_pass_def_has_color(const struct rhw_pass_def *def);

#endif
