// SPDX-License-Identifier: MIT
// See pose_reader.h.
#include "pose_reader.h"

#include "sanitizer.h"

static void *read_one(void *user)
{
    struct cli_pose_reader *const reader = user;
    reader->pose = cli_movement_pose(reader->movement, reader->render, reader->frame);
    return NULL;
}

// Reading forks a process. libc sees to it that its locks are free in there; a sanitizer does not, whose allocator
// another thread may hold.
static void begin(struct cli_pose_reader *reader)
{
    reader->pose = NULL;
    reader->reads = !SYSTEM_SANITIZED && reader->frame < reader->movement->frame_count &&
                    pthread_create(&reader->thread, NULL, read_one, reader) == 0;
}

void cli_pose_reader_open(struct cli_pose_reader *reader, const struct cli_movement *movement,
                          const struct render *render)
{
    *reader = (struct cli_pose_reader){.movement = movement, .render = render};
    begin(reader);
}

struct scene_model *cli_pose_reader_next(struct cli_pose_reader *reader)
{
    if (reader->reads) {
        pthread_join(reader->thread, NULL);
    } else {
        read_one(reader); // the system gives no thread
    }
    struct scene_model *const pose = reader->pose;
    reader->frame++;
    begin(reader);
    return pose;
}

void cli_pose_reader_close(struct cli_pose_reader *reader)
{
    if (reader->reads) {
        pthread_join(reader->thread, NULL);
        cli_movement_free_pose(reader->pose);
    }
    reader->reads = false;
}
