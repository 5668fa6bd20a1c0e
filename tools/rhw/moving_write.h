// SPDX-License-Identifier: MIT
// Files of several pictures that follow one another: animated PNG and animated WebP, repeated without end.
#ifndef CLI_MOVING_WRITE_H
#define CLI_MOVING_WRITE_H

#include "image_write.h"

struct cli_moving {
    struct cli_output_file *file;
    enum cli_picture_format format; ///< PNG or WEBP
    int frame_count, frame;         ///< of all, and of those added
    double rate;                    ///< pictures per second
    int quality;                    ///< of WebP, as for cli_webp_write
    uint32_t sequence;              ///< of APNG's chunks
    void *webp;                     ///< WebPAnimEncoder
};

/// `file` is open and gets all there is; all pictures have the size, channels and bits of the first.
void cli_moving_open(struct cli_moving *moving, struct cli_output_file *file, enum cli_picture_format format,
                     int frame_count, double rate, int quality);
/// Reports failure; finish too.
bool cli_moving_add(struct cli_moving *moving, const struct cli_raster *raster);
bool cli_moving_finish(struct cli_moving *moving);
/// After finish too.
void cli_moving_close(struct cli_moving *moving);

#endif
