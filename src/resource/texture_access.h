// SPDX-License-Identifier: MIT
// Who may touch a texture's texels between draws. What is drawn into may be touched when its pass has ended. What
// recorded draws read stays as it is, so that a texture which is written gets new memory.
#ifndef RHW_TEXTURE_ACCESS_H
#define RHW_TEXTURE_ACCESS_H

#include "rhw/types.h"

struct rhw_texture_data;

// Return true if the pass being recorded draws into the texture, or into texels that it shares.
bool rhw_texture_is_attached(const struct rhw_context *context, const struct rhw_texture_data *texture);

// Report texels that are to be written while the pass being recorded samples them, where the texture cannot get new
// memory.
bool rhw_texture_check_unread(const struct rhw_context *context, rhw_texture id,
                              const struct rhw_texture_data *texture, const char *where);

// Report an attachment of the pass being recorded: what it holds is known when the pass has ended.
bool rhw_texture_check_unattached(const struct rhw_context *context, rhw_texture id,
                                  const struct rhw_texture_data *texture, const char *where);

// Return the texture as it may be written now. It is other data than `texture` where draws that were recorded read
// `texture`. Return NULL when out of memory.
struct rhw_texture_data *rhw_texture_to_write(struct rhw_context *context, rhw_texture id,
                                              struct rhw_texture_data *texture);

#endif
