// SPDX-License-Identifier: MIT
// The formulas of perspective in exact arithmetic (GMP's rationals), on what the pipeline begins with: snapped
// positions, 1/W and values of vertices. Every number that a float or a double holds is a rational; nothing is rounded
// but where a result becomes a double to be printed.
#ifndef CLI_EXACT_WEIGHTS_H
#define CLI_EXACT_WEIGHTS_H

#include "rhw/explain.h"

#include <gmp.h>

struct cli_exact_weights {
    bool is_snapped; ///< else values follow from the homogeneous triangle, and there are no edges
    int64_t edge[3]; ///< e_0, e_1, e_2 where values are taken, 1/65536 pixel²
    int64_t sum;     ///< twice the triangle's area
    mpq_t screen[3]; ///< r, s, t = edge / sum
    mpq_t inverse_w; ///< r/W_0 + s/W_1 + t/W_2
    mpq_t space[3];  ///< a, b, c = r/W_0 / inverse_w, ..
};

/// Of a fragment that was shaded in a picture of that size, its viewport. False where the triangle has no area. Free
/// what is set.
bool cli_exact_weights_set(struct cli_exact_weights *weights, const struct rhw_explained_fragment *fragment,
                           int width, int height);
void cli_exact_weights_free(struct cli_exact_weights *weights);

/// One component three ways, as doubles beside the rationals; NaN where a value is not finite.
struct cli_three_ways {
    double naive;  ///< r·I_0 + s·I_1 + t·I_2
    double exact;  ///< what its qualifier says: a, b, c for smooth
    float written; ///< by the pipeline
    double
        error; ///< |written − exact| in ULP of the largest vertex value; noperspective, of a triangle that is not
               ///< snapped: times the largest weight, if that is above 1
};
void cli_exact_component(const struct cli_exact_weights *weights,
                         const struct rhw_explained_fragment *fragment, int component,
                         struct cli_three_ways *ways);

#endif
