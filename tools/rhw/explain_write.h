// SPDX-License-Identifier: MIT
// How rhw explain says what it found: as a worked example to read, and as JSON.
#ifndef CLI_EXPLAIN_WRITE_H
#define CLI_EXPLAIN_WRITE_H

#include "history.h"

struct cli_explanation {
    const char *model_path;
    const struct scene_model *model;
    const struct cli_history *history;
    int x, y, sample, samples, width, height;
    uint8_t color[4]; ///< of the picture there, sRGB
};

void cli_explain_text(const struct cli_explanation *explanation);
void cli_explain_json(const struct cli_explanation *explanation);

#endif
