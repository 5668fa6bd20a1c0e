// SPDX-License-Identifier: MIT
// What a model file may take and read: for programs that draw files of strangers.
#ifndef CLI_BUDGET_H
#define CLI_BUDGET_H

#include "model.h"

struct cli_budget {
    size_t memory;      ///< bytes of address space; 0: no limit of ours
    double seconds;     ///< of wall time; 0: no limit
    uint32_t texture;   ///< longest side of a texture; 0: what the picture can use
    bool is_confined;   ///< nothing is read outside `folder`
    const char *folder; ///< NULL: that of the model
};

enum { CLI_BUDGET_MEMORY = 700, CLI_BUDGET_TIME, CLI_BUDGET_TEXTURE, CLI_BUDGET_CONFINE, CLI_BUDGET_END };

/// The option `id`, one of those above, was given. Reports what is wrong with its argument.
bool cli_parse_budget(struct cli_budget *budget, int id, const char *argument);
/// Whether this system keeps a limit of memory; warns of one that it does not keep.
bool cli_budget_check(const struct cli_budget *budget);
/// Limits this process, which works on `subject`, and, but for time, what it starts.
void cli_budget_apply(const struct cli_budget *budget, const char *subject);
/// The longest side of textures that a picture can use whose longer side has so many pixels: a power of two.
uint32_t cli_budget_texture_side(int pixels);

#endif
