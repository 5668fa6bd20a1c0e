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

/// A picture of them, as far as it can be encoded without the others. Zeroed: none.
struct cli_moving_frame {
    char *bytes; ///< of a PNG file; NULL for WebP
    size_t size;
};

/// `file` is open and gets all there is; all pictures have the size, channels and bits of the first.
void cli_moving_open(struct cli_moving *moving, struct cli_output_file *file, enum cli_picture_format format,
                     int frame_count, double rate, int quality);
/// Any number of threads may do this at once. Reports failure; free the frame by cli_moving_forget whatever came of it.
bool cli_moving_encode(const struct cli_moving *moving, const struct cli_raster *raster,
                       struct cli_moving_frame *frame);
void cli_moving_forget(struct cli_moving_frame *frame);
/// One after the other. Reports failure; finish too.
bool cli_moving_add(struct cli_moving *moving, const struct cli_raster *raster,
                    const struct cli_moving_frame *frame);
bool cli_moving_finish(struct cli_moving *moving);
/// After finish too.
void cli_moving_close(struct cli_moving *moving);

#endif
