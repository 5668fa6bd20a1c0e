// SPDX-License-Identifier: MIT
// See tally.h.
#include "tally.h"

#include <math.h>

static int bin_of(double error)
{
    int exponent;
    const double fraction = frexp(error, &exponent); // 0.5 .. 1
    if (error == 0 || exponent - 1 < TALLY_LOWEST) {
        return 0;
    }
    if (!(exponent - 1 < TALLY_HIGHEST)) {
        return TALLY_BINS - 1;
    }
    return (exponent - 1 - TALLY_LOWEST) * TALLY_PER_OCTAVE + (int)((fraction * 2 - 1) * TALLY_PER_OCTAVE);
}

void tally_add(struct tally *t, double error, const struct tally_place *at)
{
    const double counted = isnan(error) ? (double)INFINITY : error;
    t->count++;
    t->bin[isinf(counted) ? TALLY_BINS - 1 : bin_of(counted)]++;
    if (counted > t->worst) {
        t->worst = counted;
        t->at = *at;
    }
}

// Of equals the earlier scene wins, so that the result does not depend on which worker measured what.
static int earlier(const struct tally_place *a, const struct tally_place *b)
{
    return a->family != b->family ? a->family < b->family : a->index < b->index;
}

void tally_merge(struct tally *into, const struct tally *from)
{
    into->count += from->count;
    for (int i = 0; i < TALLY_BINS; i++) {
        into->bin[i] += from->bin[i];
    }
    if (from->worst > into->worst ||
        (from->worst == into->worst && from->count != 0 && earlier(&from->at, &into->at))) {
        into->worst = from->worst;
        into->at = from->at;
    }
}

double tally_percentile(const struct tally *t, double part)
{
    const double wanted = part * (double)t->count;
    uint64_t sum = 0;
    for (int i = 0; i < TALLY_BINS; i++) {
        sum += t->bin[i];
        if ((double)sum >= wanted) {
            const double high = ldexp(1 + (double)(i % TALLY_PER_OCTAVE + 1) / TALLY_PER_OCTAVE,
                                      i / TALLY_PER_OCTAVE + TALLY_LOWEST);
            return high < t->worst ? high : t->worst;
        }
    }
    return t->worst;
}
