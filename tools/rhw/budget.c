// SPDX-License-Identifier: MIT
// See budget.h.
#include "budget.h"

#include "memory_limit.h"
#include "options.h"
#include "output_file.h"

#include <stdlib.h>
#include <strings.h>

enum { LEAST_MEGABYTES = 64, LEAST_SIDE = 1024 };

// "512M", "2G", "1.5g".
static bool parse_bytes(const char *text, size_t *bytes)
{
    char *end;
    const double number = strtod(text, &end);
    const double unit = strcasecmp(end, "G") == 0 ? 0x1p30 : strcasecmp(end, "M") == 0 ? 0x1p20 : 0.0;
    if (end == text || !(number * unit >= LEAST_MEGABYTES * 0x1p20) || number * unit > 0x1p50) {
        return false;
    }
    *bytes = (size_t)(number * unit);
    return true;
}

bool cli_parse_budget(struct cli_budget *budget, int id, const char *argument)
{
    int side, count;
    switch (id) {
    case CLI_BUDGET_MEMORY:
        if (parse_bytes(argument, &budget->memory)) {
            return true;
        }
        cli_error("--max-memory", "'%s' is not a size like 512M or 2G, and at least %dM", argument,
                  LEAST_MEGABYTES);
        return false;
    case CLI_BUDGET_TIME:
        if (cli_parse_numbers(argument, 1, 1, &budget->seconds, &count) && budget->seconds >= 0.1 &&
            budget->seconds <= 86400.0) {
            return true;
        }
        cli_error("--max-time", "'%s' is not a number of seconds, 0.1 to 86400", argument);
        return false;
    case CLI_BUDGET_TEXTURE:
        if (cli_parse_int(argument, 1, RHW_MAX_TARGET_SIZE, &side)) {
            budget->texture = (uint32_t)side;
            return true;
        }
        cli_error("--max-texture", "'%s' is not a number of 1 to %d", argument, RHW_MAX_TARGET_SIZE);
        return false;
    default:
        budget->is_confined = true;
        budget->folder = argument;
        return true;
    }
}

bool cli_budget_check(const struct cli_budget *budget)
{
    const bool is_kept = system_memory_limit_is_there();
    if (budget->memory > 0 && !is_kept) {
        cli_warning("--max-memory", "is not kept, as this system sets no such limit");
    }
    return is_kept;
}

void cli_budget_apply(const struct cli_budget *budget, const char *subject)
{
    if (cli_budget_check(budget) && budget->memory > 0) {
        system_memory_limit_set(budget->memory);
    }
    if (budget->seconds > 0.0) {
        cli_output_files_deadline(budget->seconds, subject);
    }
}

uint32_t cli_budget_texture_side(int pixels)
{
    uint32_t side = LEAST_SIDE;
    while (side < RHW_MAX_TARGET_SIZE && side * 2 <= 4 * (uint32_t)pixels) {
        side *= 2;
    }
    return side;
}
