// SPDX-License-Identifier: MIT
// ZIP by minizip: stored and deflated entries.
#include "zip.h"

#include <string.h>
#include <strings.h>

#include "zip64.h"

struct scene_zip {
    struct scene_import *import;
    unzFile file;
    const char *entry; // open now
    bool open;
};

// No deflated byte stands for more than 1032 (the longest match, 258 bytes, takes two bits); what is larger than this
// has no use in a model.
enum { MOST_PER_BYTE = 1032 };
static const uint64_t most_bytes = (uint64_t)2 << 30;

struct scene_zip *scene_zip_open(struct scene_import *import)
{
    struct scene_zip *zip = scene_import_allocate(import, 1, sizeof *zip);
    zip->import = import;
    zip->file = scene_zip64_open(import, import->model.path);
    if (zip->file == NULL) {
        scene_import_fail(import, "is cut or no ZIP archive: it has no list of its files at the end");
    }
    return zip;
}

static void check_claim(struct scene_zip *zip, const unz_file_info64 *info)
{
    const unsigned long long claimed = info->uncompressed_size, stored = info->compressed_size;
    if (info->flag & 1) {
        scene_import_fail(zip->import, "\"%s\" in the archive is encrypted", zip->entry);
    }
    if (info->compression_method != 0 && info->compression_method != Z_DEFLATED) {
        scene_import_fail(zip->import,
                          "\"%s\" in the archive is compressed by method %lu; deflate (8) is read",
                          zip->entry, info->compression_method);
    }
    if (claimed > most_bytes || claimed / MOST_PER_BYTE > stored) {
        scene_import_fail(
            zip->import,
            "\"%s\" in the archive claims to be %llu bytes made of %llu; at most %llu, and %d times what "
            "it is made of, are read",
            zip->entry, claimed, stored, (unsigned long long)most_bytes, MOST_PER_BYTE);
    }
}

bool scene_zip_enter(struct scene_zip *zip, const char *name, size_t *size)
{
    enum { CASE_IGNORED = 2 };
    unz_file_info64 info;
    if (zip->open) {
        unzCloseCurrentFile(zip->file);
        zip->open = false;
    }
    zip->entry = scene_import_string(zip->import, name, strlen(name));
    if (unzLocateFile(zip->file, name, CASE_IGNORED) != UNZ_OK) {
        return false;
    }
    if (unzGetCurrentFileInfo64(zip->file, &info, NULL, 0, NULL, 0, NULL, 0) != UNZ_OK) {
        scene_import_fail(zip->import, "\"%s\" in the archive is damaged", zip->entry);
    }
    check_claim(zip, &info);
    if (unzOpenCurrentFile(zip->file) != UNZ_OK) {
        scene_import_fail(zip->import, "\"%s\" in the archive is damaged", zip->entry);
    }
    zip->open = true;
    *size = (size_t)info.uncompressed_size;
    return true;
}

size_t scene_zip_read(struct scene_zip *zip, void *bytes, size_t size)
{
    const unsigned step = size < 1u << 30 ? (unsigned)size : 1u << 30;
    const int count = unzReadCurrentFile(zip->file, bytes, step);
    // The checksum is compared when an entry that was read to its end is closed.
    const bool whole = count == 0 && unzeof(zip->file) == 1;
    if (count < 0 || (count == 0 && size > 0 && !whole)) {
        scene_import_fail(zip->import, "\"%s\" in the archive is damaged or cut", zip->entry);
    }
    if (whole && size > 0) {
        zip->open = false;
        if (unzCloseCurrentFile(zip->file) == UNZ_CRCERROR) {
            scene_import_fail(zip->import, "\"%s\" in the archive is damaged: its checksum is another",
                              zip->entry);
        }
    }
    return (size_t)count;
}

void *scene_zip_read_all(struct scene_zip *zip, const char *name, size_t *size)
{
    if (!scene_zip_enter(zip, name, size)) {
        return NULL;
    }
    char *bytes = scene_import_allocate(zip->import, *size + 1, 1), end;
    size_t done = 0;
    for (size_t step = 1; done < *size && step > 0; done += step) {
        step = scene_zip_read(zip, bytes + done, *size - done);
    }
    if (done < *size || (zip->open && scene_zip_read(zip, &end, 1) != 0)) {
        scene_import_fail(zip->import, "\"%s\" in the archive is damaged or cut", zip->entry);
    }
    return bytes;
}

const char *scene_zip_find_ending(struct scene_zip *zip, const char *ending)
{
    char name[256];
    const size_t length = strlen(ending);
    for (int result = unzGoToFirstFile(zip->file); result == UNZ_OK; result = unzGoToNextFile(zip->file)) {
        if (unzGetCurrentFileInfo64(zip->file, NULL, name, sizeof name, NULL, 0, NULL, 0) != UNZ_OK) {
            return NULL;
        }
        name[sizeof name - 1] = 0;
        const size_t all = strlen(name);
        if (all > length && strcasecmp(name + all - length, ending) == 0) {
            return scene_import_string(zip->import, name, all);
        }
    }
    return NULL;
}
