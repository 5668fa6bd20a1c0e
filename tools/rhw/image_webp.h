// SPDX-License-Identifier: MIT
// A raster as libwebp takes it, for still and moving pictures.
#ifndef CLI_IMAGE_WEBP_H
#define CLI_IMAGE_WEBP_H

#include "image_write.h"

#include <webp/encode.h>

/// `quality` as for cli_webp_write. On success free the picture by WebPPictureFree.
bool cli_webp_prepare(WebPConfig *config, WebPPicture *picture, const struct cli_raster *raster, int quality);

#endif
