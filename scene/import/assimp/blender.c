// SPDX-License-Identifier: MIT
// Blender files, of which assimp 5.2.5 does not say all, and cannot read some. It reads most files up to version 2.8
// and some up to 3.1, so these are refused by their version only where assimp gives up. It finds nothing in files of
// version 4, or crashes. Files may be compressed, by gzip before version 3 and by zstd since then.
#include "assimp.h"
#include "blender_dump.h"
#include "blender_gaps.h"
#include "blender_shading.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { MAYBE_UNREAD = 290, UNREAD = 400 };

// Return the version times 100 of a header. Return 0 if it is none. Before version 5 the header is BLENDER, a letter
// each for the size of pointers and the order of bytes, and three digits. Since then it is BLENDER17-01v and four
// digits.
static unsigned find_version(const char *header)
{
    if (strncmp(header, "BLENDER", 7) != 0) {
        return 0;
    }
    const char *mark = strpbrk(header + 7, "vV");
    return mark == NULL ? 0 : (unsigned)strtoul(mark + 1, NULL, 10);
}

void scene_assimp_refuse_blender(struct scene_import *import, bool is_tried)
{
    char header[18] = "";
    const gzFile file = gzopen(import->model.path, "rb"); // it also reads what is not compressed
    if (file == NULL) {
        return;
    }
    const int read = gzread(file, header, sizeof header - 1);
    const size_t count = read < 0 ? 0 : (size_t)read;
    gzclose(file);
    const size_t digits = strncmp(header, "BLENDER17", 9) == 0 ? 17 : 12;
    header[count < digits ? count : digits] = 0;
    const unsigned version = find_version(header);
    if (version >= (is_tried ? MAYBE_UNREAD : UNREAD)) {
        scene_import_fail(import, "is a Blender file of version %u.%u, which is not supported", version / 100,
                          version % 100 % 10 == 0 ? version % 100 / 10 : version % 100);
    }
}

void scene_assimp_look_at_blender(struct scene_import *import, struct scene_blender_shadings *shadings)
{
    struct scene_blender_file file;
    if (scene_blender_open(import, &file)) {
        scene_blender_tell_gaps(import, &file);
        scene_blender_find_shadings(import, &file, shadings);
        scene_blender_close(&file);
    }
}
