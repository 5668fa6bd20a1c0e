// SPDX-License-Identifier: MIT
// The poses of a model that moves, one after the other, each read while the one before it is drawn.
#ifndef CLI_POSE_READER_H
#define CLI_POSE_READER_H

#include "movement.h"

#include <pthread.h>

struct cli_pose_reader {
    const struct cli_movement *movement;
    const struct render *render;
    // ---
    pthread_t thread;
    bool reads; // there is such a thread
    int frame;
    struct scene_model *pose;
};

/// Begins to read that of picture 0. What both point to must live until the end.
void cli_pose_reader_open(struct cli_pose_reader *reader, const struct cli_movement *movement,
                          const struct render *render);
/// The next pose, for the caller to free; NULL after a report.
struct scene_model *cli_pose_reader_next(struct cli_pose_reader *reader);
void cli_pose_reader_close(struct cli_pose_reader *reader);

#endif
