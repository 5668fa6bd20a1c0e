// SPDX-License-Identifier: MIT
// See coarseness.h. Levels are tried one after the other, and the times of neighbours compared: a finer level that
// takes hardly longer than a coarser one is better.
#include "coarseness.h"

enum {
    LEVEL_LAST = VIEW_COARSENESS_LEVELS - 1,
    SLOW_MS = 50, // a picture of something that moves takes no longer, or the next is coarser
    QUICK_MS = 12 // or the next is finer
};

static const double gain = 1.25;    // of a coarser level that is worth it
static const double change = 1.6;   // of one level's time, by which another thing is seen now
static const double expected = 3.0; // of a level whose time is not known

struct view_coarseness view_coarseness_start(void)
{
    return (struct view_coarseness){.level = VIEW_COARSENESS_FIRST, .last = LEVEL_LAST};
}

struct view_coarse_look view_coarseness_look(int level)
{
    static const struct view_coarse_look looks[VIEW_COARSENESS_LEVELS] = {{1, false, false}, {1, true, false},
                                                                          {1, true, true},   {2, true, true},
                                                                          {4, true, true},   {8, true, true}};
    return looks[level];
}

// The level from `level` on that is expected to be fast enough.
static int coarser(const struct view_coarseness *c, int level, double ms)
{
    while (ms > SLOW_MS && level < c->last) {
        ms /= expected;
        level++;
    }
    return level;
}

// What was known of other levels was of something else where this one takes much more or less than it did.
static void forget_where_changed(struct view_coarseness *c, int level, double ms)
{
    const double before = c->ms[level];
    if (before > 0.0 && (ms > change * before || before > change * ms)) {
        for (int i = 0; i < VIEW_COARSENESS_LEVELS; i++) {
            c->ms[i] = 0.0;
        }
        c->last = LEVEL_LAST;
    }
    c->ms[level] = ms;
}

// Whether a coarser level is known to gain.
static bool has_better(const struct view_coarseness *c, int level, double ms)
{
    bool found = false;
    for (int i = level + 1; i <= c->last; i++) {
        found = found || (c->ms[i] > 0.0 && gain * c->ms[i] < ms);
    }
    return found;
}

static int choose(struct view_coarseness *c, int level, double ms)
{
    const double finer_ms = level > 0 ? c->ms[level - 1] : 0.0;
    if (level > 0 && finer_ms > 0.0 && finer_ms < gain * ms && ms > QUICK_MS && !has_better(c, level, ms)) {
        c->last = level - 1;
        return level - 1;
    }
    if (ms > SLOW_MS) {
        const bool is_untried = level == c->last && level > 1 && finer_ms <= 0.0;
        return is_untried ? level - 1 : coarser(c, level, ms);
    }
    return ms < QUICK_MS && level > 0 && finer_ms <= SLOW_MS ? level - 1 : level;
}

void view_coarseness_learn(struct view_coarseness *c, int level, bool hurried, double ms)
{
    forget_where_changed(c, level, ms);
    if (hurried) {
        c->level = choose(c, level, ms);
        return;
    }
    c->level = coarser(c, 0, ms);
    while (c->ms[c->level] > SLOW_MS && c->level < c->last) {
        c->level++;
    }
}
