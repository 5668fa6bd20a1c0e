// SPDX-License-Identifier: MIT
#include "clusters.h"

#include <math.h>

static bool is_near(const struct scene_box *a, const struct scene_box *b)
{
    const double reach = 0.25 * SCENE_REMOTE;
    const struct scene_box near =
        scene_box_grown(a, reach * fmax(scene_box_longest(a), scene_box_longest(b)));
    return scene_box_overlaps(&near, b);
}

void scene_import_clusters_add(struct scene_import_clusters *clusters, const struct scene_box *box)
{
    for (uint32_t i = 0; i < clusters->count; i++) {
        if (is_near(&clusters->boxes[i], box) || i + 1 == SCENE_IMPORT_CLUSTERS) {
            scene_box_extend(&clusters->boxes[i], box);
            return;
        }
    }
    clusters->boxes[clusters->count++] = *box;
}

void scene_import_clusters_join(struct scene_import_clusters *clusters)
{
    for (uint32_t i = 0; i < clusters->count; i++) {
        for (uint32_t k = i + 1; k < clusters->count; k++) {
            if (is_near(&clusters->boxes[i], &clusters->boxes[k])) {
                scene_box_extend(&clusters->boxes[i], &clusters->boxes[k]);
                clusters->boxes[k] = clusters->boxes[--clusters->count];
                k = i; // it has grown, so that what was far may be near
            }
        }
    }
}

uint32_t scene_import_clusters_find(const struct scene_import_clusters *clusters, const struct scene_box *box)
{
    uint32_t found = 0;
    while (found + 1 < clusters->count && !scene_box_holds(&clusters->boxes[found], box)) {
        found++;
    }
    return found;
}
