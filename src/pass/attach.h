// SPDX-License-Identifier: MIT
// A definition's attachments become the target of the pass that is recorded.
#ifndef RHW_PASS_ATTACH_H
#define RHW_PASS_ATTACH_H

#include "rhw/pass_def.h"

struct rhw_encoder;

// Set what the pass draws into, and its width and height too where they are 0. Misuse is reported as misuse of
// rhw_pass_begin.
enum rhw_result rhw_pass_attach(struct rhw_encoder *encoder, const struct rhw_pass_def *def);

// Return true if a definition has a colour attachment that is not left out.
bool rhw_pass_def_has_color(const struct rhw_pass_def *def);

#endif
