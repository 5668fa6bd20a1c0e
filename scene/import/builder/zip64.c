// SPDX-License-Identifier: MIT
// An entry of a ZIP archive whose size or place is 0xFFFFFFFF has the number in an extra field (APPNOTE 4.5.3). Writers
// that do not know sizes beforehand write small entries so, too. minizip 1.1 passes over that field where a long has
// 64 bits, so it is given such an archive with the numbers in their usual places: the bytes are replaced as it reads
// them.
#include "zip64.h"

#include <string.h>

enum {
    CENTRAL = 46,
    COMPRESSED = 20,
    UNCOMPRESSED = 24,
    NAME = 28,
    EXTRA = 30,
    LOCAL = 42,
    MOST_EXTRA = 65535
};
static const uint32_t elsewhere = UINT32_MAX;

// Four bytes of the file that are read as others.
struct patch {
    uint64_t place;
    unsigned char bytes[4];
};

struct archive {
    struct scene_import *import;
    zlib_filefunc64_def base; // minizip's functions for files
    struct patch *patches;    // by their places
    size_t count, capacity;
};

static uint32_t number(const unsigned char *bytes, int size)
{
    uint32_t value = 0;
    for (int i = size - 1; i >= 0; i--) {
        value = value << 8 | bytes[i];
    }
    return value;
}

static voidpf open_archive(voidpf opaque, const void *path, int mode)
{
    const struct archive *archive = opaque;
    return archive->base.zopen64_file(archive->base.opaque, path, mode);
}

static uLong read_archive(voidpf opaque, voidpf stream, void *buffer, uLong size)
{
    const struct archive *archive = opaque;
    const uint64_t start = archive->count > 0 ? archive->base.ztell64_file(archive->base.opaque, stream) : 0;
    const uLong count = archive->base.zread_file(archive->base.opaque, stream, buffer, size);
    size_t low = 0, high = archive->count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (archive->patches[middle].place + 4 <= start) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    for (; low < archive->count && archive->patches[low].place < start + count; low++) {
        const struct patch *patch = &archive->patches[low];
        for (uint64_t i = 0; i < 4; i++) {
            if (patch->place + i >= start && patch->place + i < start + count) {
                ((unsigned char *)buffer)[patch->place + i - start] = patch->bytes[i];
            }
        }
    }
    return count;
}

static ZPOS64_T tell_archive(voidpf opaque, voidpf stream)
{
    const struct archive *archive = opaque;
    return archive->base.ztell64_file(archive->base.opaque, stream);
}

static long seek_archive(voidpf opaque, voidpf stream, ZPOS64_T offset, int origin)
{
    const struct archive *archive = opaque;
    return archive->base.zseek64_file(archive->base.opaque, stream, offset, origin);
}

static int close_archive(voidpf opaque, voidpf stream)
{
    const struct archive *archive = opaque;
    return archive->base.zclose_file(archive->base.opaque, stream);
}

static int error_of_archive(voidpf opaque, voidpf stream)
{
    const struct archive *archive = opaque;
    return archive->base.zerror_file(archive->base.opaque, stream);
}

// Read bytes of the file at a place. Return false if there are not so many.
static bool read_at(const struct archive *archive, voidpf stream, uint64_t place, void *bytes, size_t size)
{
    return archive->base.zseek64_file(archive->base.opaque, stream, place, ZLIB_FILEFUNC_SEEK_SET) == 0 &&
           archive->base.zread_file(archive->base.opaque, stream, bytes, (uLong)size) == size;
}

// Return the data of the extra field 0x0001, and set its size. Return NULL if there is none.
static const unsigned char *find_field(const unsigned char *extra, size_t extra_size, size_t *size)
{
    for (size_t at = 0; at + 4 <= extra_size; at += 4 + *size) {
        *size = number(extra + at + 2, 2);
        if (number(extra + at, 2) == 1 && at + 4 + *size <= extra_size) {
            return extra + at + 4;
        }
    }
    return NULL;
}

// Add what has to be replaced in the entry of the central directory at `place`. The extra field has numbers of 64 bits
// for those of the three that are not in their usual places, in this order. A number that needs more than 32 bits is
// left as it is.
static void add_patches(struct archive *archive, voidpf stream, uint64_t place)
{
    static const int fields[] = {UNCOMPRESSED, COMPRESSED, LOCAL};
    unsigned char header[CENTRAL], extra[MOST_EXTRA];
    if (!read_at(archive, stream, place, header, sizeof header) || memcmp(header, "PK\1\2", 4) != 0) {
        return;
    }
    const size_t extra_size = number(header + EXTRA, 2);
    size_t size = 0, used = 0;
    const bool is_read =
        read_at(archive, stream, place + CENTRAL + number(header + NAME, 2), extra, extra_size);
    const unsigned char *data = is_read ? find_field(extra, extra_size, &size) : NULL;
    const size_t first = archive->count;
    for (int i = 0; i < 3 && data != NULL; i++) {
        if (number(header + fields[i], 4) != elsewhere || used + 8 > size) {
            continue;
        }
        if (number(data + used + 4, 4) == 0 && number(data + used, 4) != elsewhere) {
            scene_import_reserve(archive->import, &archive->patches, &archive->capacity, archive->count + 1,
                                 sizeof *archive->patches);
            struct patch *patch = &archive->patches[archive->count++];
            patch->place = place + (uint64_t)fields[i];
            memcpy(patch->bytes, data + used, sizeof patch->bytes);
        }
        used += 8;
    }
    // The compressed size stands before the other one in the file.
    if (archive->count - first >= 2 && archive->patches[first].place > archive->patches[first + 1].place) {
        const struct patch later = archive->patches[first];
        archive->patches[first] = archive->patches[first + 1];
        archive->patches[first + 1] = later;
    }
}

static void find_patches(struct archive *archive, unzFile file, voidpf stream)
{
    uint64_t last = 0;
    for (int result = unzGoToFirstFile(file); result == UNZ_OK; result = unzGoToNextFile(file)) {
        const uint64_t place = unzGetOffset64(file);
        if (place <= last && last > 0) {
            return; // a hostile archive goes in circles
        }
        add_patches(archive, stream, place);
        last = place;
    }
}

unzFile scene_zip64_open(struct scene_import *import, const char *path)
{
    struct archive *archive = scene_import_allocate(import, 1, sizeof *archive);
    archive->import = import;
    fill_fopen64_filefunc(&archive->base);
    zlib_filefunc64_def functions = {.zopen64_file = open_archive,
                                     .zread_file = read_archive,
                                     .ztell64_file = tell_archive,
                                     .zseek64_file = seek_archive,
                                     .zclose_file = close_archive,
                                     .zerror_file = error_of_archive,
                                     .opaque = archive};
    const int mode = ZLIB_FILEFUNC_MODE_READ | ZLIB_FILEFUNC_MODE_EXISTING;
    const unzFile file = unzOpen2_64(path, &functions);
    voidpf stream = file == NULL ? NULL : archive->base.zopen64_file(archive->base.opaque, path, mode);
    if (stream != NULL) {
        find_patches(archive, file, stream);
        archive->base.zclose_file(archive->base.opaque, stream);
    }
    return file;
}
