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

static uint32_t find_near(const struct scene_import_clusters *clusters, const struct scene_box *box)
{
    // Elements that follow one another mostly stand together.
    if (clusters->count > 0 && scene_box_holds(&clusters->boxes[clusters->last], box)) {
        return clusters->last;
    }
    uint32_t found = 0;
    while (found < clusters->count && !is_near(&clusters->boxes[found], box)) {
        found++;
    }
    return found < SCENE_IMPORT_CLUSTERS ? found : SCENE_IMPORT_CLUSTERS - 1;
}

uint32_t scene_import_clusters_add(struct scene_import_clusters *clusters, const struct scene_box *box)
{
    const uint32_t found = find_near(clusters, box);
    if (found == clusters->count) {
        clusters->boxes[clusters->count++] = *box;
    }
    scene_box_extend(&clusters->boxes[found], box);
    clusters->last = found;
    return found;
}

static void rename_joined(struct scene_import_clusters *clusters, uint32_t before, uint32_t after)
{
    for (uint32_t i = 0; i < SCENE_IMPORT_CLUSTERS; i++) {
        clusters->joined[i] = clusters->joined[i] == before ? after : clusters->joined[i];
    }
}

void scene_import_clusters_join(struct scene_import_clusters *clusters)
{
    for (uint32_t i = 0; i < SCENE_IMPORT_CLUSTERS; i++) {
        clusters->joined[i] = i;
    }
    for (uint32_t i = 0; i < clusters->count; i++) {
        for (uint32_t k = i + 1; k < clusters->count; k++) {
            if (is_near(&clusters->boxes[i], &clusters->boxes[k])) {
                scene_box_extend(&clusters->boxes[i], &clusters->boxes[k]);
                clusters->boxes[k] = clusters->boxes[--clusters->count];
                rename_joined(clusters, k, i);
                rename_joined(clusters, clusters->count, k);
                k = i; // it has grown, so that what was far may be near
            }
        }
    }
}
